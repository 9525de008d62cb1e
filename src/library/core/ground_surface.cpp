// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/ground_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ranges>

namespace flagstone {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// The finest grid with cell centres on all sides of (x, y). Grids as large as the coarsest one
/// also cover the outer half of their outermost cells. Null if no grid covers the position.
const GroundSurface::Grid* covering(std::span<const GroundSurface::Grid> grids, float x,
                                    float y) noexcept {
  const float reach = std::max(std::abs(x), std::abs(y));
  if (std::isnan(x) || std::isnan(y)) return nullptr;
  for (const GroundSurface::Grid& grid : std::views::reverse(grids)) {
    const bool outermost = grid.extent() >= grids.front().extent();
    const float extent = outermost ? grid.extent() : grid.extent() - grid.cell / 2;
    if (grid.extent() > 0 && reach <= extent) return &grid;
  }
  return nullptr;
}

/// Linear interpolation from a to b. An end with weight 0 has no influence, even if it is NaN.
float between(float a, float b, float share_of_b) noexcept {
  if (share_of_b <= 0) return a;
  if (share_of_b >= 1) return b;
  return a + share_of_b * (b - a);
}

/// Position between the centres of two neighbouring cells along one axis. Positions beyond the last
/// centre are moved to it.
struct Between {
  Between(float coordinate, float cell, std::size_t width) noexcept {
    const float centre = coordinate / cell + (static_cast<float>(width) - 1) / 2;
    const float clamped = std::clamp(centre, 0.0f, static_cast<float>(width - 1));
    first = std::min(static_cast<std::size_t>(clamped), width - 2);
    share = clamped - static_cast<float>(first);
  }
  std::size_t first;  ///< index of the first of the two cells
  float share;        ///< weight of the second cell, 0 to 1
};

/// The four cells whose centres surround a position.
class Square {
 public:
  Square(const GroundSurface::Grid& grid, float x, float y) noexcept
      : column_(x, grid.cell, grid.width),
        row_(y, grid.cell, grid.width),
        width_(grid.width),
        first_(row_.first * grid.width + column_.first) {}

  /// The interpolated value.
  [[nodiscard]] float of(const std::vector<float>& values) const noexcept {
    const float* const near = values.data() + first_;
    const float* const far = near + width_;
    return between(between(near[0], near[1], column_.share), between(far[0], far[1], column_.share),
                   row_.share);
  }

  /// Derivative of the value along x and y, per cell; NaN if one of the four values is NaN.
  [[nodiscard]] std::array<float, 2> growth(const std::vector<float>& values) const noexcept {
    const float* const near = values.data() + first_;
    const float* const far = near + width_;
    const float twist = (far[1] - far[0]) - (near[1] - near[0]);
    return {near[1] - near[0] + row_.share * twist, far[0] - near[0] + column_.share * twist};
  }

 private:
  Between column_, row_;
  std::size_t width_;
  std::size_t first_;
};

}  // namespace

float GroundSurface::extent() const noexcept { return empty() ? 0 : grids().front().extent(); }

float GroundSurface::resolution(float x, float y) const noexcept {
  const Grid* const grid = covering(grids(), x, y);
  return grid == nullptr ? unknown : grid->cell;
}

float GroundSurface::height(float x, float y) const noexcept {
  const Grid* const grid = covering(grids(), x, y);
  return grid == nullptr ? unknown : Square(*grid, x, y).of(grid->heights);
}

GroundSample GroundSurface::at(float x, float y) const noexcept {
  GroundSample ground{
      .height = unknown, .normal = {unknown, unknown, unknown}, .slope = unknown, .confidence = 0};
  const Grid* const grid = covering(grids(), x, y);
  if (grid == nullptr) return ground;
  const Square square(*grid, x, y);
  ground.height = square.of(grid->heights);
  if (std::isnan(ground.height)) return ground;
  ground.confidence = square.of(grid->confidences);
  const auto [per_cell_x, per_cell_y] = square.growth(grid->heights);
  const float along_x = per_cell_x / grid->cell;
  const float along_y = per_cell_y / grid->cell;
  const float length = std::hypot(along_x, along_y, 1.0f);
  ground.normal = {-along_x / length, -along_y / length, 1 / length};
  ground.slope = std::atan(std::hypot(along_x, along_y));
  return ground;
}

}  // namespace flagstone
