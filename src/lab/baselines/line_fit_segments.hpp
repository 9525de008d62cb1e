// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/baselines/line_fit.hpp"
#include "lab/baselines/line_fit_extraction.hpp"
#include "lab/baselines/polar_grid.hpp"
#include "lab/baselines/usable_points.hpp"

namespace flagstone::baselines {

/// The lowest point of every bin that has points: sectors of the grid are the
/// paper's segments, its rings the bins of a segment.
class LowestPoints {
 public:
  explicit LowestPoints(const PolarGrid& grid);

  /// Takes the lowest of the points of each bin; of equally low ones the nearest.
  void collect(const UsablePoints& points, const float* ranges,
               std::span<const std::uint32_t> bins) noexcept;

  /// The prototypes of a segment, nearest first. Valid until the next call.
  [[nodiscard]] std::span<const Prototype> of_segment(std::uint32_t segment) noexcept;

 private:
  std::uint32_t segments_;
  std::uint32_t bins_a_segment_;
  std::vector<Prototype> lowest_;   ///< one per bin of the grid; range -1 where it has no point
  std::vector<Prototype> segment_;  ///< of_segment's answer
};

/// The lines of all segments.
class GroundLines {
 public:
  GroundLines(const PolarGrid& grid, const LineFitConfig& config);

  void extract(LowestPoints& lowest) noexcept;

  /// Vertical distance, metres, from a point to the line that reaches its range: one of its own
  /// segment, else of the nearest segments to either side within the search angle, where the
  /// farther of two is believed. Infinity where there is none.
  [[nodiscard]] float distance(std::uint32_t segment, float range, float height) const noexcept;

 private:
  [[nodiscard]] float distance_within(std::uint32_t segment, float range,
                                      float height) const noexcept;

  LineFitConfig config_;
  std::uint32_t segments_;
  std::uint32_t search_steps_;             ///< segments to look through on either side
  std::vector<GroundLine> lines_;          ///< segment by segment, nearest first
  std::vector<std::uint32_t> first_line_;  ///< of each segment, and one past the last
};

}  // namespace flagstone::baselines
