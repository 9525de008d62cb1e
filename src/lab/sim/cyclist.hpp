// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Someone riding a bicycle 1.7 m long, both of the class bicyclist; `frame` stands on the ground
/// between the wheels and looks forward.
void add_cyclist(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
