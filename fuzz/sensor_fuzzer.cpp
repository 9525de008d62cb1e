// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "cloud_properties.hpp"
#include "files/io/sensor_file.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/sensor.hpp"
#include "flagstone/surface_config.hpp"
#include "text_properties.hpp"

// Any text as a sensor file. Reading it and deriving the settings of the methods either succeed or
// report one line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace flagstone;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  Sensor sensor;
  const Status status = io::parse_sensor(text, "fuzz.toml", sensor);
  if (!status.ok()) {
    fuzz::check_line(status.message());
    return 0;
  }
  try {
    PatchworkConfig::for_sensor(sensor).check();
    SurfaceConfig::for_sensor(sensor).check();
  } catch (const std::invalid_argument& error) {
    fuzz::check_line(error.what());
  }
  return 0;
}
