// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "files/render/canvas.hpp"
#include "files/render/contours.hpp"
#include "files/render/height_map.hpp"

namespace flagstone::render {

/// How ground is drawn.
struct ReliefLook {
  HeightRange heights;      ///< range of the colours; heights outside have the first or last colour
  double exaggeration = 1;  ///< factor by which slopes are multiplied for shading
  ContourStep step;         ///< between contour lines
};

/// Colours that span `heights`, from contour line to contour line, and shading that shows gentle
/// slopes. `steep` is a slope that few slopes exceed, m/m.
ReliefLook suitable_look(const HeightRange& heights, double steep) noexcept;

/// Slope in m/m from the heights `distance` metres before and after a position. One-sided if one of
/// them is NaN, 0 if both are.
double slope(double before, double here, double after, double distance) noexcept;

/// The colour of ground at `height`, shaded with light from the upper left, as a pixel of
/// CAIRO_FORMAT_ARGB32. `rise_up` and `rise_left` are the slopes towards the upper and the left
/// edge of the image, m/m; `opacity` is 0 to 1. 0, the transparent pixel, is for unknown ground.
std::uint32_t relief_pixel(double height, double rise_up, double rise_left, const ReliefLook& look,
                           double opacity = 1) noexcept;

/// Rows of relief_pixel().
struct ReliefPixels {
  std::span<std::uint32_t> pixels;
  std::size_t width;
};

/// Where ReliefPixels are in an image.
struct ReliefPlacement {
  double x, y;               ///< upper left corner, pixels
  double pixels_per_sample;  ///< Cairo interpolates between the samples
};

/// Paints ground over the background of `panel`.
void paint_relief(const Canvas& canvas, const Rectangle& panel, const ReliefPixels& relief,
                  const ReliefPlacement& placement) noexcept;

/// Draws the legend: a bar of the colours with round heights, the contour lines, the exaggeration
/// of slopes, and `note` above it.
void draw_relief_legend(const Canvas& canvas, const Rectangle& legend, const ReliefLook& look,
                        const std::string& note, double unit);

}  // namespace flagstone::render
