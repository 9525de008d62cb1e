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

/// The lowest point of every bin that contains points. The sectors of the grid are the segments of
/// the paper, and its rings are the bins of a segment.
class LowestPoints {
 public:
  explicit LowestPoints(const PolarGrid& grid);

  /// Finds the lowest point of each bin; among equally low points, the nearest.
  void collect(const UsablePoints& points, const float* ranges,
               std::span<const std::uint32_t> bins) noexcept;

  /// The prototypes of a segment, nearest first. The span is valid until the next call.
  [[nodiscard]] std::span<const Prototype> of_segment(std::uint32_t segment) noexcept;

 private:
  std::uint32_t segments_;
  std::uint32_t bins_per_segment_;
  std::vector<Prototype> lowest_;   ///< one per bin of the grid; range -1 for empty bins
  std::vector<Prototype> segment_;  ///< the result of of_segment()
};

/// The lines of all segments.
class GroundLines {
 public:
  GroundLines(const PolarGrid& grid, const LineFitConfig& config);

  void extract(LowestPoints& lowest) noexcept;

  /// Vertical distance, metres, from a point to the line that covers its range. If its segment has
  /// no such line, the nearest segments on both sides within the search angle are searched, and the
  /// larger of two distances is used. Infinity if there is no line.
  [[nodiscard]] float distance(std::uint32_t segment, float range, float height) const noexcept;

 private:
  [[nodiscard]] float distance_within(std::uint32_t segment, float range,
                                      float height) const noexcept;

  LineFitConfig config_;
  std::uint32_t segments_;
  std::uint32_t search_steps_;             ///< number of segments to search on each side
  std::vector<GroundLine> lines_;          ///< segment by segment, nearest first
  std::vector<std::uint32_t> first_line_;  ///< index of the first line of each segment, and the end
};

}  // namespace flagstone::baselines
