// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Length and width of every bus, metres.
inline constexpr double bus_length = 12;
inline constexpr double bus_width = 2.5;

/// A low-floor city bus: body, a belt of windows, wheels. `frame` stands on the ground below its
/// middle.
void add_bus(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
