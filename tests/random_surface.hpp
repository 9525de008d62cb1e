// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "flagstone/ground_surface.hpp"

namespace flagstone::tests {

/// Height of made-up ground at (x, y), metres; NaN where it is not known.
using Ground = std::function<float(float, float)>;

/// The size of a grid of a made-up surface.
struct GridSize {
  float cell;         ///< metres
  std::size_t width;  ///< cells along a side
};

/// Grids for 32 m around the sensor, finer within 8 m: small, with two to choose from.
inline const std::vector<GridSize> two_grids = {{.cell = 1, .width = 64},
                                                {.cell = 0.25f, .width = 64}};

/// The surface whose grids hold this ground at the centres of their cells, with confidence 1, or 0
/// where it is not known.
GroundSurface random_surface(const Ground& ground, std::span<const GridSize> grids = two_grids);

}  // namespace flagstone::tests
