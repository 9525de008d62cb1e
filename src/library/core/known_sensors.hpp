// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/sensor.hpp"

namespace flagstone {

/// The sensors of folder sensors/, in the order in which CMakeLists.txt lists them.
std::vector<Sensor> make_known_sensors();

}  // namespace flagstone
