// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flagstone::render {

/// A place on a grid of samples, in samples: (2, 0.5) lies between the first two of the third
/// column.
struct GridPlace {
  double column, row;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

/// A line along which heights are the same. A closed one has its first place again as its last.
using ContourLine = std::vector<GridPlace>;

/// Where heights between samples, bilinear in each square of four, pass `level`: marching squares,
/// joined to lines as long as they can be. `heights` are rows of `width` samples; a square with a
/// height that is not finite has no line. A line ends at the samples' edge, at such a square, or
/// where it began. A height equal to `level` counts as above.
std::vector<ContourLine> contour_lines(std::span<const float> heights, std::size_t width,
                                       float level);

}  // namespace flagstone::render
