// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "app/doctor/summary.hpp"
#include "flagstone/sensor.hpp"

namespace flagstone::doctor {

/// The known sensors that could have made such scans, the likeliest first.
std::vector<const Sensor*> matching_sensors(const Summary& summary);

}  // namespace flagstone::doctor
