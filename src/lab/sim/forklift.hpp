// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Length with the fork and width of every forklift, metres.
inline constexpr double forklift_length = 3.4;
inline constexpr double forklift_width = 1.2;

/// A forklift truck with mast, overhead guard and driver, its fork just above the floor, with or
/// without a load. `frame` stands on the ground below its middle.
void add_forklift(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
