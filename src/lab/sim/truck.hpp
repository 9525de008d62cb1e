// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Length and width of every truck, metres.
inline constexpr double truck_length = 15.6;
inline constexpr double truck_width = 2.5;

/// A tractor with a semi-trailer (box, tank or flatbed with a load), hollow below. `frame` stands
/// on the ground below its middle.
void add_truck(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
