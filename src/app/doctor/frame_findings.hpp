// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "app/doctor/diagnosis.hpp"

namespace flagstone::doctor {

/// Adds how the clouds' frame stands to the ground: units and ground and, if there is ground, axes,
/// tilt, origin and sensor_height. `advice` is there if ground is.
void add_frame_findings(const Summary& summary, const Expected& expected,
                        const std::optional<Advice>& advice, std::vector<Finding>& findings);

}  // namespace flagstone::doctor
