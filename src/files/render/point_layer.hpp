// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "files/render/canvas.hpp"
#include "files/render/point_kinds.hpp"
#include "files/render/top_view.hpp"
#include "flagstone/cloud_view.hpp"

namespace flagstone::render {

/// Draws the points as small discs straight into the canvas's pixels, kind after kind, cut off at
/// the panel's edges. `unit` is the size of a pixel of the default picture. Returns how many points
/// to be drawn lie beyond the panel (also: are not finite).
std::size_t draw_points(const Canvas& canvas, const TopView& view, CloudView cloud,
                        const PointKinds& points, double unit);

}  // namespace flagstone::render
