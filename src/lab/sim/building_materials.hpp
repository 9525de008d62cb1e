// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A heap of gravel, sand or earth (class other_object) that was put upon the land: as steep as
/// loose material lies, 33 to 38 degrees, more than a vehicle climbs. The land goes on below it.
struct Heap {
  double x = 0, y = 0;  ///< middle, metres
  double radius = 3;    ///< metres
  double stretch = 1;   ///< how much longer it is along x than across
};
void add_heap(Mesh& mesh, const Ground& ground, const Heap& heap, Random& random);

/// @name Things on the ground (class other_object); `frame` stands on it below their middle
/// @{
/// Pipes along x, `length` metres long, a row on top of another.
void add_pipe_stack(Mesh& mesh, const Frame& frame, double length, Random& random);
/// A pallet, 14 cm high, with up to 1.2 m of bricks on it.
void add_brick_pallet(Mesh& mesh, const Frame& frame, Random& random);
/// A board, 2 to 5 m long along x, 20 to 50 cm wide, 4 cm thick, that lies on the ground.
void add_board(Mesh& mesh, const Frame& frame, Random& random);
/// @}

/// A container, 6 m long, 2.4 m wide, 2.6 m high (class other_structure). `frame` stands on the
/// ground below its middle, x along it.
void add_container(Mesh& mesh, const Frame& frame);

/// A panel of wire mesh on two feet, 3.4 m wide along x, 2 m high (class fence): most beams pass.
void add_mesh_panel(Mesh& mesh, const Frame& frame);

}  // namespace flagstone::sim
