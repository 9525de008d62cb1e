// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "flagstone/sensor.hpp"
#include "flagstone/surface_config.hpp"

namespace flagstone {
namespace {

constexpr double least_range = 8;  // what check() allows, metres
constexpr double most_range = 200;

}  // namespace

SurfaceConfig SurfaceConfig::for_sensor(const Sensor& sensor) {
  sensor.check();
  SurfaceConfig config;
  config.sensor_height = static_cast<float>(sensor.height);
  config.max_range = static_cast<float>(std::clamp(sensor.max_range, least_range, most_range));
  return config;
}

SurfaceConfig SurfaceConfig::for_sensor(std::string_view name) {
  return for_sensor(Sensor::named(name));
}

}  // namespace flagstone
