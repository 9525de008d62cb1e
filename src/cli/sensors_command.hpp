// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::cli {

/// `flagstone sensors`: prints the sensors there are, and the zones that Patchwork derives from
/// each.
void add_sensors_command(CLI::App& app, int& exit_code);

/// What the rule made of a sensor, in lines: the sensor, the rule, rings, zones and bins.
std::string derivation_text(const Sensor& sensor, const PatchworkConfig& config);

}  // namespace flagstone::cli
