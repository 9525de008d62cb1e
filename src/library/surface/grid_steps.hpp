// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "library/surface/grid.hpp"

namespace flagstone::surface {

/// Gives a grid the heights and confidences of the one it lies in, whose cells are twice as wide
/// and of which it covers as much or less, around the same middle.
void upsample(const Grid& coarse, const Grid& fine) noexcept;

/// Adds corrections to heights, by cell, metres. Where something else borders the grid (`inner`),
/// they fade to nothing at the outermost cells, so that the surface has no step there. Confidence
/// becomes the larger of what it was and that of the correction.
void correct(const float* corrections, const float* confidences, bool inner,
             const Grid& grid) noexcept;

}  // namespace flagstone::surface
