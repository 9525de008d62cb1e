// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lab/sim/ground_step.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// A corner of a cross-section: metres outward from the start of the edge, and up.
struct EdgeCorner {
  double out, height;
};

/// A slope of an edge, between two of its corners, whose height is evaluated.
struct MeasuredSlope {
  std::string_view name;
  std::size_t from, to;
};

/// Cross-section of the land next to a road: level before the first corner and after the last.
struct EdgeKind {
  std::vector<EdgeCorner> corners;
  std::vector<MeasuredSlope> slopes;
  Surface surface;                 ///< from the first corner outward
  std::vector<Surface> between{};  ///< between adjacent corners, if it differs from `surface`
};

/// An edge of some kind that starts at a distance from the centre line of a road.
struct Edge {
  const EdgeKind* kind;
  double begin;  ///< metres

  /// Height at `out` metres from the centre line, above the side of the road, metres.
  [[nodiscard]] double height(double out) const noexcept;

  /// Surface at `out` metres, which must be beyond `begin`.
  [[nodiscard]] const Surface& surface(double out) const noexcept;
};

/// One side of a straight road along x, in blocks of equal length with one edge each. At both ends
/// of a block its edge blends into the adjacent one.
struct EdgeRow {
  double x_begin = 0;       ///< of the first block, metres
  double block_length = 0;  ///< metres
  double blend = 0;         ///< length at each end of a block on which it blends, metres
  std::vector<Edge> blocks;

  /// @name At x, `out` metres from the centre line; the first and last block extend beyond the row
  /// @{
  [[nodiscard]] double height(double x, double out) const noexcept;
  [[nodiscard]] const Edge& edge_at(double x) const noexcept { return blocks[block_at(x)]; }
  /// @}

  [[nodiscard]] std::size_t block_at(double x) const noexcept;
  [[nodiscard]] double begin_of(std::size_t block) const noexcept {
    return x_begin + static_cast<double>(block) * block_length;
  }

  /// Distances of all corners from the centre line.
  [[nodiscard]] std::vector<double> corner_lines() const;

  /// Values of x at which blending starts and ends.
  [[nodiscard]] std::vector<double> blend_lines() const;

  /// The measured slopes, on the parts of the blocks that do not blend. `side`: +1 to the left of
  /// the road, -1 to the right.
  [[nodiscard]] std::vector<GroundStep> steps(double side) const;
};

/// Dimensions of a road between the slope of a dam and a cutting.
struct DamMeasures {
  double dam = 3;          ///< height of the dam above the land next to it, metres
  double run = 1.7;        ///< horizontal distance per metre of height, m/m
  double drop = 2;         ///< of the retaining wall below the road, metres
  double cut = 3;          ///< height of the land next to the cutting above the road, metres
  double ditch = 0.8;      ///< depth, metres
  double bottom = 0.8;     ///< width of its flat bottom, metres
  double cut_ditch = 0.5;  ///< depth of the ditch below the cutting, metres
  bool wet = false;        ///< whether the ditch of the dam contains water
};

/// Edges down the dam: a slope, a slope with a ditch at its base, a retaining wall. Walls are not
/// ground, although they are part of the ground surface.
std::vector<EdgeKind> dam_kinds(const DamMeasures& with);

/// Edges up the cutting, behind a ditch: a slope, a retaining wall.
std::vector<EdgeKind> cutting_kinds(const DamMeasures& with);

}  // namespace flagstone::sim
