// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "lab/sim/ground_step.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// A corner of a cross-section: metres outward from where the edge begins, and up.
struct EdgeCorner {
  double out, height;
};

/// A slope of an edge whose height is measured: between two of its corners.
struct MeasuredSlope {
  std::string_view name;
  std::size_t from, to;
};

/// What lies beside a road: level before the first corner and behind the last.
struct EdgeKind {
  std::vector<EdgeCorner> corners;
  std::vector<MeasuredSlope> slopes;
  Surface surface;                 ///< from the first corner outward
  std::vector<Surface> between{};  ///< from each corner but the last to the next, where it differs
};

/// An edge of some kind that begins so far from a road's centre line.
struct Edge {
  const EdgeKind* kind;
  double begin;  ///< metres

  /// `out` metres from the centre line, above the height of the road's side, metres.
  [[nodiscard]] double height(double out) const noexcept;

  /// What it is made of there; its begin must lie before.
  [[nodiscard]] const Surface& surface(double out) const noexcept;
};

/// One side of a straight road along x, in blocks of equal length with an edge each. At either end
/// of a block its edge turns into the next one.
struct EdgeRow {
  double x_begin = 0;       ///< of the first block, metres
  double block_length = 0;  ///< metres
  double blend = 0;         ///< length at either end of a block on which it turns, metres
  std::vector<Edge> blocks;

  /// @name At x, `out` metres from the centre line; beyond the row its first or last block goes on
  /// @{
  [[nodiscard]] double height(double x, double out) const noexcept;
  [[nodiscard]] const Edge& edge_at(double x) const noexcept { return blocks[block_at(x)]; }
  /// @}

  [[nodiscard]] std::size_t block_at(double x) const noexcept;
  [[nodiscard]] double begin_of(std::size_t block) const noexcept {
    return x_begin + static_cast<double>(block) * block_length;
  }

  /// Distances from the centre line of every corner there is.
  [[nodiscard]] std::vector<double> corner_lines() const;

  /// Where blocks begin to turn and have turned: lines of x.
  [[nodiscard]] std::vector<double> blend_lines() const;

  /// Measured slopes of those parts of the blocks that are the same from end to end. `side`: +1 to
  /// the left of the road, -1 to the right.
  [[nodiscard]] std::vector<GroundStep> steps(double side) const;
};

/// Measures of a road between a dam's slope and a cutting.
struct DamMeasures {
  double dam = 3;          ///< how much lower the land lies beside the dam, metres
  double run = 1.7;        ///< metres out for a metre down or up
  double drop = 2;         ///< of the retaining wall below the road, metres
  double cut = 3;          ///< how much higher the land lies beside the cutting
  double ditch = 0.8;      ///< depth, metres
  double bottom = 0.8;     ///< width of its flat bottom, metres
  double cut_ditch = 0.5;  ///< depth of the one below the cutting, metres
  bool wet = false;        ///< is there water in the dam's ditch?
};

/// Down the dam: a slope, a slope with a ditch at its foot, a retaining wall. Walls are no ground,
/// though they belong to its surface.
std::vector<EdgeKind> dam_kinds(const DamMeasures& with);

/// Up the cutting, behind a ditch: a slope, a retaining wall.
std::vector<EdgeKind> cutting_kinds(const DamMeasures& with);

}  // namespace flagstone::sim
