// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A heap of gravel, sand or earth (class other_object) on the land. Its slope is the angle of
/// repose of loose material, 33 to 38 degrees, steeper than a vehicle can climb. The land continues
/// below it.
struct Heap {
  double x = 0, y = 0;  ///< middle, metres
  double radius = 3;    ///< metres
  double stretch = 1;   ///< length along x relative to its width
};
void add_heap(Mesh& mesh, const Ground& ground, const Heap& heap, Random& random);

/// @name Objects on the ground (class other_object); `frame` is on the ground below their middle
/// @{
/// Pipes along x, `length` metres long, in rows on top of each other.
void add_pipe_stack(Mesh& mesh, const Frame& frame, double length, Random& random);
/// A pallet, 14 cm high, with up to 1.2 m of bricks on it.
void add_brick_pallet(Mesh& mesh, const Frame& frame, Random& random);
/// A board on the ground, 2 to 5 m long along x, 20 to 50 cm wide, 4 cm thick.
void add_board(Mesh& mesh, const Frame& frame, Random& random);
/// @}

/// A container, 6 m long, 2.4 m wide, 2.6 m high (class other_structure). `frame` is on the ground
/// below its middle, x along it.
void add_container(Mesh& mesh, const Frame& frame);

/// A panel of wire mesh on two feet, 3.4 m wide along x, 2 m high (class fence). Most beams pass
/// through.
void add_mesh_panel(Mesh& mesh, const Frame& frame);

/// Objects in a warehouse. Every frame is on the floor.

/// Height of an empty pallet, metres.
inline constexpr double pallet_height = 0.145;

/// A pallet, 1.2 m along x by 0.8 m, on three runners that beams can pass between. Its load is
/// `load` metres high; 0 for none.
void add_pallet(Mesh& mesh, const Frame& frame, double load, Random& random);

/// A row of racks, metres.
struct Rack {
  int bays = 8;    ///< each rack_bay long
  int levels = 4;  ///< above the floor, which also has pallets
};
inline constexpr double rack_bay = 2.8;
inline constexpr double rack_depth = 1.1;

/// Uprights, beams and pallets with loads. `frame` is in the middle of one end, x along the row.
void add_rack(Mesh& mesh, const Frame& frame, const Rack& rack, Random& random);

/// A hand pallet truck with its tiller up, 1.5 m long.
void add_pallet_truck(Mesh& mesh, const Frame& frame);

}  // namespace flagstone::sim
