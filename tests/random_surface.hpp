// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "flagstone/ground_surface.hpp"

namespace flagstone::tests {

/// Height of the ground at (x, y), metres; NaN if it is unknown.
using Ground = std::function<float(float, float)>;

/// The size of a grid.
struct GridSize {
  float cell;         ///< metres
  std::size_t width;  ///< number of cells along a side
};

/// Two small grids: 32 m around the sensor, and a finer one for 8 m.
inline const std::vector<GridSize> two_grids = {{.cell = 1, .width = 64},
                                                {.cell = 0.25f, .width = 64}};

/// A surface with the height of this ground at the cell centres of its grids. The confidence is 1,
/// or 0 if the height is unknown.
GroundSurface random_surface(const Ground& ground, std::span<const GridSize> grids = two_grids);

}  // namespace flagstone::tests
