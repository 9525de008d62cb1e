// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Dimensions of a house, metres.
struct House {
  double width = 10;   ///< along the street
  double depth = 9;    ///< away from it
  double eaves = 5.5;  ///< height of the walls
  double buried = 2;   ///< depth of the walls below the ground at the front, for slopes
};

/// Walls that reach into the ground, recessed windows, a gabled roof, a door with a step. `frame`
/// is on the ground in the middle of the front wall, x along the wall and y into the house.
void add_house(Mesh& mesh, const Frame& frame, const House& house, Random& random);

/// Dimensions of a terraced town house, metres.
struct TerraceHouse {
  double width = 8;   ///< along the street
  double depth = 11;  ///< away from it
  int storeys = 4;    ///< above the ground floor
  bool shop = true;   ///< a reflective glass front behind a low plinth
};

/// Height of the walls, metres.
double height_of(const TerraceHouse& house) noexcept;

/// Walls that reach 2 m into the ground, recessed windows, a door step, sometimes balconies and an
/// awning. `frame` is on the ground in the middle of the front wall, x along the wall and y into
/// the house.
void add_terrace_house(Mesh& mesh, const Frame& frame, const TerraceHouse& house, Random& random);

}  // namespace flagstone::sim
