// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "flagstone/patchwork_config.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::cli {

/// Comment lines that describe the zones derived from a sensor: the rule, and the number of rings,
/// zones and bins.
std::string derivation_text(const Sensor& sensor, const PatchworkConfig& config);

}  // namespace flagstone::cli
