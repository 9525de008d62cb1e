// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A walking person, 1.55 to 1.9 m tall. `frame` is on the ground, x forward.
void add_person(Mesh& mesh, const Frame& frame, Random& random);

/// A person on a bicycle 1.7 m long, both of the class bicyclist. `frame` is on the ground between
/// the wheels, x forward.
void add_cyclist(Mesh& mesh, const Frame& frame, Random& random);

}  // namespace flagstone::sim
