// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "files/render/canvas.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone::render {

/// Half of the picture's shorter side in metres where the caller names none: the radius that holds
/// 98 % of the points that can be drawn, rounded up to 10 m; at most the last ring's of `zones`,
/// where given, and 1,000 m. Without points, that bound or 50 m.
double suitable_range(CloudView cloud, std::span<const Label> labels, const PatchworkConfig* zones);

/// Distance between range rings, metres: 1, 2 or 5 times a power of ten, such that at least three
/// rings fit into `range`.
double ring_step(double range) noexcept;

/// Radii of the circles to caption, ascending, metres: multiples of ring_step() as far as they
/// reach into the panel's corners, or the zones' ends where zones are drawn.
std::vector<double> circle_radii(double range, const PatchworkConfig* zones);

/// Dashed circles of these radii, metres, around the sensor.
void draw_range_rings(const Canvas& canvas, const TopView& view, std::span<const double> radii,
                      double unit) noexcept;

/// An arrowhead at the origin that points forward.
void draw_sensor(const Canvas& canvas, const TopView& view, double unit) noexcept;

/// What tells place, size and direction, on top of the points: the circles' captions in metres, the
/// mark of the sensor, the axes (lower left) and the scale bar (lower right). `radii` ascend.
void draw_scale(const Canvas& canvas, const TopView& view, double range,
                std::span<const double> radii, double unit, const PanelInk& ink = dark_panel_ink);

}  // namespace flagstone::render
