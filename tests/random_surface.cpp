// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "random_surface.hpp"

#include <cmath>

namespace flagstone::tests {
namespace {

GroundSurface::Grid grid_of(const Ground& ground, const GridSize& size) {
  GroundSurface::Grid grid{
      .cell = size.cell, .width = size.width, .heights = {}, .confidences = {}};
  const auto centre = [&](std::size_t index) {
    return (static_cast<float>(index) + 0.5f - static_cast<float>(size.width) / 2) * size.cell;
  };
  for (std::size_t row = 0; row < size.width; ++row) {
    for (std::size_t column = 0; column < size.width; ++column) {
      const float height = ground(centre(column), centre(row));
      grid.heights.push_back(height);
      grid.confidences.push_back(std::isnan(height) ? 0.0f : 1.0f);
    }
  }
  return grid;
}

}  // namespace

GroundSurface random_surface(const Ground& ground, std::span<const GridSize> grids) {
  GroundSurface surface;
  std::vector<GroundSurface::Grid>& filled = surface.start();
  for (const GridSize& size : grids) filled.push_back(grid_of(ground, size));
  return surface;
}

}  // namespace flagstone::tests
