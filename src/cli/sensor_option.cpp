// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sensor_option.hpp"

#include <fmt/format.h>

#include <CLI/Option.hpp>
#include <stdexcept>

#include "app/config/config_file.hpp"
#include "app/config/config_toml.hpp"
#include "files/io/sensor_file.hpp"

namespace flagstone::cli {
CLI::Option* add_sensor_option(CLI::App& command, std::string& sensor) {
  return command
      .add_option("--sensor", sensor,
                  "Derive settings from this sensor: a name that 'flagstone sensors' lists, or a "
                  ".toml file of your own")
      ->type_name("NAME|FILE");
}

std::optional<Sensor> chosen_sensor(const std::string& option, const std::string& config_file,
                                    const std::string& preset) {
  const std::optional<std::string> in_file = config::sensor_named_in_file(config_file);
  if (option.empty() && !in_file) return std::nullopt;
  if (!option.empty() && in_file) {
    throw std::invalid_argument(
        fmt::format("--sensor {}: {} names a sensor too; give one of them", option, config_file));
  }
  const std::string origin = in_file ? config_file + ": sensor" : "--sensor";
  if (preset != "default") {
    throw std::invalid_argument(
        fmt::format("{} beside --preset {}: settings start from one or the other", origin, preset));
  }
  Sensor sensor;
  const Status status = io::find_sensor(in_file ? *in_file : option, sensor);
  if (!status.ok()) throw std::invalid_argument(fmt::format("{}: {}", origin, status.message()));
  return sensor;
}

void refuse_sensor_in_setting(const std::string& setting, const std::string& source) {
  if (!config::sensor_named_in(setting, source)) return;
  throw std::invalid_argument(
      fmt::format("{}: a sensor is named by --sensor, or at the top of a --config file", source));
}

}  // namespace flagstone::cli
