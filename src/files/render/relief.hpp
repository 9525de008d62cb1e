// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "files/render/canvas.hpp"
#include "files/render/height_map.hpp"
#include "files/render/palette.hpp"
#include "files/render/top_view.hpp"
#include "flagstone/ground_surface.hpp"

namespace flagstone::render {

/// How ground is coloured.
struct ReliefLook {
  HeightRange heights;      ///< what lies below has the first colour, what lies above the last
  double exaggeration = 1;  ///< how much steeper than it is ground is shaded
};

/// The colour of a height before shading, from `share` 0, the lowest, to 1, the highest.
Color height_color(double share) noexcept;

/// Draws the ground within `range` metres of the sensor: by height, shaded as if light fell from
/// the upper left, paler where the surface is less sure, nothing where it is not known.
void draw_relief(const Canvas& canvas, const TopView& view, const GroundSurface& surface,
                 double range, const ReliefLook& look);

}  // namespace flagstone::render
