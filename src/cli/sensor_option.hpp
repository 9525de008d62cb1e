// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "flagstone/sensor.hpp"

namespace flagstone::cli {

/// Adds --sensor to a command: what settings are derived from.
CLI::Option* add_sensor_option(CLI::App& command, std::string& sensor);

/// The sensor that settings are derived from: the one of --sensor, or the one that the key `sensor`
/// of the --config file names, files beside that file. Either may be empty. Throws
/// std::invalid_argument with one line where there is no such sensor, a file of it is bad, both
/// name one, or --preset is not default.
std::optional<Sensor> chosen_sensor(const std::string& option, const std::string& config_file,
                                    const std::string& preset);

/// Throws std::invalid_argument where a setting names a sensor. `source`: the option it stands in.
void refuse_sensor_in_setting(const std::string& setting, const std::string& source);

}  // namespace flagstone::cli
