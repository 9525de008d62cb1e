// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/beam_spacing.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

namespace flagstone {

double measured_beam_spacing(const PointArrays& points) {
  constexpr double bin = 0.05;  // degrees
  constexpr double min_spacing = 0.35;
  constexpr double max_spacing = 2.5;
  constexpr int min_gap = 5;  // bins; smaller ones are noise of one beam
  constexpr int max_gap = 60;
  Directions directions;
  directions.compute(points, identity_transform,
                     {.rows_per_radian = static_cast<float>(180 / (bin * std::numbers::pi))});
  std::array<std::vector<std::int32_t>, PixelGrid::columns> columns;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!(directions.range(k) > 0)) continue;
    columns.at(static_cast<std::size_t>(directions.column(k))).push_back(directions.row(k));
  }
  std::array<std::size_t, max_gap + 1> gaps{};
  std::size_t count = 0;
  for (std::vector<std::int32_t>& rows : columns) {
    std::ranges::sort(rows);
    for (std::size_t k = 1; k < rows.size(); ++k) {
      const std::int32_t gap = rows[k] - rows[k - 1];
      if (gap < min_gap || gap > max_gap) continue;
      ++gaps.at(static_cast<std::size_t>(gap));
      ++count;
    }
  }
  std::size_t median = 0;
  for (std::size_t below = gaps[0]; 2 * below < count; below += gaps.at(++median)) {
  }
  return std::clamp(static_cast<double>(median) * bin, min_spacing, max_spacing);
}

}  // namespace flagstone
