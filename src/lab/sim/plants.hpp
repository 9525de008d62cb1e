// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A trunk with boughs (class trunk) and a crown of leaves that some beams pass through.
void add_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// Leaves from the ground up, about 1 m high.
void add_bush(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A few blades above a lawn, 5 to 25 cm high: the objects that are hardest to distinguish from
/// ground.
void add_tuft(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A patch of low vegetation, 1 to 3 m wide and 8 to 35 cm high, that partly covers the ground.
void add_ground_cover(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A clipped hedge along the straight line from (x0, y0) to (x1, y1), metres.
struct Hedge {
  double x0, y0, x1, y1;
  double width = 0.7, height = 1.2;
};
void add_hedge(Mesh& mesh, const Ground& ground, const Hedge& hedge, Random& random);

/// A circular patch of high grass, with shorter blades towards its edge.
struct HighGrass {
  double x = 0, y = 0;  ///< middle, metres
  double radius = 4;    ///< metres
  double height = 0.6;  ///< of the tallest blades, metres
};

/// 90 blades per square metre, class vegetation: a beam at 15 degrees below the horizon has a
/// probability of about 0.2 to reach the ground through grass 50 cm high.
void add_high_grass(Mesh& mesh, const Ground& ground, const HighGrass& grass, Random& random);

/// Overhanging fronds, 40 to 90 cm high.
void add_fern(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A tree of a dense forest: a slim trunk, 9 to 16 m high, bare except for dead branches, below a
/// narrow crown.
void add_forest_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

/// A bough with leaves from 2 m above (x, y) in the direction `yaw` (radians). Its tip, 2 m away,
/// may be as low as 1 m.
void add_low_branch(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random);

/// A trunk lying on the ground (class trunk), 3 to 7 m long, in the direction `yaw`, radians.
void add_fallen_log(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random);

/// A stump, 20 to 50 cm high (class trunk).
void add_stump(Mesh& mesh, const Ground& ground, double x, double y, Random& random);

}  // namespace flagstone::sim
