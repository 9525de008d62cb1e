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

/// A patch of high grass: a disc of radius `radius` whose blades are shorter towards its edge.
struct HighGrass {
  double x = 0, y = 0;  ///< middle, metres
  double radius = 4;    ///< metres
  double height = 0.6;  ///< of the tallest blades, metres
};

/// 90 blades a square metre, class vegetation: a beam that comes in at 15 degrees has about one
/// chance in five to reach the ground through 50 cm of it.
void add_high_grass(Mesh& mesh, const Ground& ground, const HighGrass& grass, Random& random);

/// Fronds that hang over to all sides, 40 to 90 cm high.
void add_fern(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A tree of a dense wood: a slim trunk, 9 to 16 m high, bare but for dead branches, below a narrow
/// crown.
void add_forest_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A bough with leaves that reaches from 2 m above (x, y) into the direction `yaw` (radians), as
/// low as 1 m at its tip, 2 m away.
void add_low_branch(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random);

/// A trunk that lies on the ground (class trunk), 3 to 7 m long, in the direction `yaw`, radians.
void add_fallen_log(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random);

/// A stump, 20 to 50 cm high (class trunk).
void add_stump(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

}  // namespace flagstone::sim
