// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "files/render/canvas.hpp"
#include "files/render/palette.hpp"
#include "files/render/top_view.hpp"

namespace flagstone::render {

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
