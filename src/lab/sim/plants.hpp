// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A trunk with boughs (class trunk) and a crown of leaves that part of the beams pass.
void add_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// Leaves from the ground up, about 1 m high.
void add_bush(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A few blades that stand out of a lawn, 5 to 25 cm high: what is hardest to tell from the ground.
void add_tuft(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A patch of low growth, 1 to 3 m wide and 8 to 35 cm high, that covers the ground below it in
/// part.
void add_ground_cover(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A clipped hedge along the straight line from (x0, y0) to (x1, y1), metres.
struct Hedge {
  double x0, y0, x1, y1;
  double width = 0.7, height = 1.2;
};
void add_hedge(Mesh& mesh, const Ground& ground, const Hedge& hedge, Random& random);

}  // namespace flagstone::sim
