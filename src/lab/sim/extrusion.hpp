// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "lab/sim/interval.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// Where a place in a road's own coordinates lies in the world: x along the road, t to the left of
/// its centre line, z above a level that the road defines. Metres.
using RoadPlace = std::function<Vector3(double x, double t, double z)>;

/// A point of an outline across a road.
struct OutlinePoint {
  double t, z;
};

/// Draws an outline along a road from x.low to x.high, in straight pieces of at most `step` metres:
/// walls, rails, vaults. An outline that ends where it begins encloses a body, whose ends are
/// closed; it has to be convex.
void add_extrusion(Mesh& mesh, std::span<const OutlinePoint> outline, Interval x, double step,
                   const RoadPlace& place, Surface surface);

/// The outline of a rectangle.
struct BeamSection {
  Interval t, z;
};
/// A body of rectangular section along a road: walls, beams, slabs.
void add_beam(Mesh& mesh, const BeamSection& section, Interval x, double step,
              const RoadPlace& place, Surface surface);

}  // namespace flagstone::sim
