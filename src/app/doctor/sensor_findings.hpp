// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/doctor/diagnosis.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::doctor {

/// Adds what the sensor is like: ego_vehicle (if there is ground), beams, field_of_view, range,
/// downsampling and sensor. `sensors`: those that match, the likeliest first.
void add_sensor_findings(const Summary& summary, const Expected& expected,
                         const std::vector<const Sensor*>& sensors, std::vector<Finding>& findings);

}  // namespace flagstone::doctor
