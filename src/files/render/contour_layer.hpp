// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "files/render/canvas.hpp"
#include "files/render/height_map.hpp"
#include "files/render/top_view.hpp"

namespace flagstone::render {

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
