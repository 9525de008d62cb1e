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

/// Which heights have lines.
struct ContourStep {
  double height;  ///< from one line to the next, metres
  int per_index;  ///< every so many-th line is an index contour: bold, with its height
};

/// Widths of the lines, pixels of the default picture.
inline constexpr double thin_contour = 1.2;
inline constexpr double bold_contour = 2.4;

/// The step that suits heights which span so many metres: about ten lines.
ContourStep suitable_step(double span) noexcept;

/// A height as a multiple of `step` is written, in metres: "-1.75", "-12".
std::string height_text(double height, const ContourStep& step);

/// Draws the contour lines of `map` at these heights; index contours last, with labels where they
/// run straight.
void draw_contours(const Canvas& canvas, const TopView& view, const HeightMap& map,
                   const HeightRange& heights, const ContourStep& step, double unit);

}  // namespace flagstone::render
