// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A person in stride, 1.55 to 1.9 m tall; `frame` stands on the ground and looks forward.
void add_person(Mesh& mesh, const Frame& frame, Random& random);

/// Someone riding a bicycle 1.7 m long, both of the class bicyclist; `frame` stands on the ground
/// between the wheels and looks forward.
void add_cyclist(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
