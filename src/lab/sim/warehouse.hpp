// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// What stands in a warehouse. Every frame stands on the floor.

/// Height of an empty pallet, metres.
inline constexpr double pallet_height = 0.145;

/// A pallet of 1.2 m along x by 0.8 m on three runners that beams pass between, with a load of
/// `load` metres on it; 0 for none.
void add_pallet(Mesh& mesh, const Frame& frame, double load, Random& random);

/// A row of racks, metres.
struct Rack {
  int bays = 8;    ///< of rack_bay each
  int levels = 4;  ///< above the floor, which has pallets too
};
inline constexpr double rack_bay = 2.8;
inline constexpr double rack_depth = 1.1;

/// Uprights, beams and pallets with loads; `frame` stands in the middle of one end, x along the
/// row.
void add_rack(Mesh& mesh, const Frame& frame, const Rack& rack, Random& random);

/// A hand pallet truck with its tiller up, 1.5 m long.
void add_pallet_truck(Mesh& mesh, const Frame& frame);

}  // namespace flagstone::sim
