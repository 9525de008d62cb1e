// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// The longest car there is, metres: what a parking place has to hold.
inline constexpr double longest_car = 5.2;

/// The widest, metres, with its wheels.
inline constexpr double widest_car = 1.97;

/// A car of a random kind (hatchback, saloon, estate, van) and paint: body with bonnet, cabin with
/// windows that reflect nearly nothing, wheels; hollow below, so that beams pass under it. `frame`
/// stands on the ground below its middle.
void add_car(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
