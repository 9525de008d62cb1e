// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "files/render/canvas.hpp"
#include "files/render/contour_layer.hpp"
#include "files/render/relief.hpp"

namespace flagstone::render {

/// Draws into `legend` the colours of heights with their metres, what the lines mean and what
/// paleness does.
void draw_surface_legend(const Canvas& canvas, const Rectangle& legend, const ReliefLook& look,
                         const ContourStep& step, double unit);

}  // namespace flagstone::render
