// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "files/render/canvas.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::render {

/// Default for half of the shorter side of the view, metres: the radius that contains 98 % of the
/// drawable points, rounded up to 10 m; at most the last ring of `zones` if given, otherwise 1,000
/// m. Without points, the last ring or 50 m.
double suitable_range(CloudView cloud, std::span<const Label> labels, const PatchworkConfig* zones);

/// Distance between range rings, metres: 1, 2 or 5 times a power of ten, so that at least three
/// rings fit into `range`.
double ring_step(double range) noexcept;

/// Radii of the circles with captions, ascending, metres: multiples of ring_step() up to the
/// corners of the panel or, if zones are drawn, the limits of the zones.
std::vector<double> circle_radii(double range, const PatchworkConfig* zones);

/// Draws dashed circles of these radii, metres, around the sensor.
void draw_range_rings(const Canvas& canvas, const TopView& view, std::span<const double> radii,
                      double unit) noexcept;

/// Draws a scale bar from (left, line) to the right, `length` pixels long, with `text` above it.
void draw_bar(cairo_t* context, double left, double line, double length, const std::string& text,
              double unit, Color color);

/// Draws an arrowhead at the origin that points forward.
void draw_sensor(const Canvas& canvas, const TopView& view, double unit) noexcept;

/// Draws the scale on top of the points: captions of the circles in metres, the mark of the sensor,
/// the axes (lower left) and the scale bar (lower right). `radii` must be ascending.
void draw_scale(const Canvas& canvas, const TopView& view, double range,
                std::span<const double> radii, double unit, const PanelInk& ink = dark_panel_ink);

}  // namespace flagstone::render
