// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "lab/sim/frame.hpp"
#include "lab/sim/mesh.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A box in a frame: the two corners with the smallest and the largest coordinates, metres.
struct Box {
  Vector3 low, high;
};
void add_box(Mesh& mesh, const Frame& frame, const Box& box, Surface surface);

/// A cross-section of a body at `x`: a trapezoid in the frame's y-z plane, symmetric about y = 0.
struct Section {
  double x = 0;
  double low = 0, high = 0;                        ///< heights of the lower and upper edge, metres
  double half_width_low = 0, half_width_high = 0;  ///< at those edges, metres
};
/// A closed body through the sections, which are ordered by x.
void add_loft(Mesh& mesh, const Frame& frame, std::span<const Section> sections, Surface surface);

/// A closed truncated cone along the straight line from `from` to `to` in the frame; `sides` >= 3.
struct Cone {
  Vector3 from, to;
  double radius_from = 0, radius_to = 0;  ///< metres
  int sides = 10;
};
void add_cone(Mesh& mesh, const Frame& frame, const Cone& cone, Surface surface);

/// Leaves in an ellipsoid: squares of every direction, more of them towards its surface.
struct Leaves {
  Vector3 centre;  ///< world frame
  Vector3 radii;   ///< half axes along x, y and z, metres
  int count = 0;
  double size = 0.15;  ///< mean edge of a leaf, metres; single ones differ by a half
};
void add_leaves(Mesh& mesh, const Leaves& leaves, Surface surface, Random& random);

}  // namespace flagstone::sim
