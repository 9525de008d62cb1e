// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/sensor.hpp"

namespace flagstone {

/// The sensors in the directory sensors/, in the order of CMakeLists.txt.
std::vector<Sensor> make_known_sensors();

}  // namespace flagstone
