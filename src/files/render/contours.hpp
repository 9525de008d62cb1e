// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "files/render/canvas.hpp"
#include "files/render/height_map.hpp"

namespace flagstone::render {

/// A position on a grid of samples, in samples: (2, 0.5) is between the first two samples of the
/// third column.
struct GridPlace {
  double column, row;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

/// A line of equal height. A closed line ends with its first position.
using ContourLine = std::vector<GridPlace>;

/// Lines along which the bilinear interpolation of `heights` equals `level`: marching squares, with
/// the segments joined to lines of maximum length. `heights` are rows of `width` samples. A square
/// of four samples has no line if a height is not finite. Lines end at the edge of the grid or at
/// such a square, or they are closed. A height equal to `level` counts as above.
std::vector<ContourLine> contour_lines(std::span<const float> heights, std::size_t width,
                                       float level);

/// The heights that have contour lines.
struct ContourStep {
  double height;  ///< difference between adjacent lines, metres
  int per_index;  ///< every line with a multiple of this number is an index contour: bold, labelled
};

/// Widths of the lines, pixels of the default image size.
inline constexpr double thin_contour = 1.2;
inline constexpr double bold_contour = 2.4;

/// A step that gives about ten lines for heights that span `span` metres.
ContourStep suitable_step(double span) noexcept;

/// A height in metres with the decimals that multiples of `step` need: "-1.75", "-12".
std::string height_text(double height, const ContourStep& step);

/// Rows of samples, and their positions in an image.
struct ContourGrid {
  std::span<const float> heights;  ///< metres; NaN if unknown
  std::size_t width;               ///< samples per row
  cairo_matrix_t to_pixels;        ///< from column and row to pixels
};

/// Draws the contour lines of `grid` within `heights` into `panel`. Index contours are drawn last,
/// with labels on their straight parts.
void draw_contours(const Canvas& canvas, const Rectangle& panel, const ContourGrid& grid,
                   const HeightRange& heights, const ContourStep& step, double unit);

}  // namespace flagstone::render
