// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The planes of cells in fixed point, compared with planes in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/cell_observations.hpp"
#include "library/surface/owned_grid.hpp"

namespace flagstone::surface {
namespace {

using tests::OwnedGrid;

constexpr float expected_ground = -1.73f;

/// The planes of a grid.
class Planes {
 public:
  explicit Planes(const OwnedGrid& owned)
      : grid_(&owned.grid()), slopes_(grid_->size() + 16), offsets_(grid_->size() + 16) {
    std::vector<float> memory;
    find_planes(owned.readable(memory), expected_ground,
                {.slopes = slopes_.data(), .offsets = offsets_.data()});
  }

  /// The height at the centre of a unit of packed points, above the expected ground, in units of a
  /// packed z. `x` and `y` are in units of packed points from the edge of the grid.
  [[nodiscard]] int at(std::int32_t x, std::int32_t y) const {
    const auto units_of_cell = static_cast<std::int32_t>(grid_->cell * xy_per_metre);
    const auto place = static_cast<std::size_t>(y / units_of_cell) * grid_->width +
                       static_cast<std::size_t>(x / units_of_cell);
    const std::int32_t slope_x = static_cast<std::int16_t>(slopes_[place] & 0xFFFF);
    const std::int32_t slope_y = slopes_[place] >> 16;
    return (slope_x * (x & 0xFF) + slope_y * (y & 0xFF) + offsets_[place]) >> 11;
  }

 private:
  const Grid* grid_;
  std::vector<std::int32_t> slopes_;
  std::vector<std::int32_t> offsets_;
};

/// The height at a position in double precision, as at() but not rounded: the plane through the
/// centre of the cell with the slopes between its neighbours.
double naive(OwnedGrid& owned, std::int32_t x, std::int32_t y) {
  const Grid& grid = owned.grid();
  const double cell = static_cast<double>(grid.cell);
  const double metres_x = (x + 0.5) / xy_per_metre;
  const double metres_y = (y + 0.5) / xy_per_metre;
  const auto column = static_cast<std::size_t>(metres_x / cell);
  const auto row = static_cast<std::size_t>(metres_y / cell);
  const auto before = [](std::size_t index) { return index > 0 ? index - 1 : index; };
  const auto after = [&](std::size_t index) { return std::min(index + 1, grid.width - 1); };
  const auto slope = [&](float from, float to, std::size_t steps) {
    const double rise =
        (static_cast<double>(to) - static_cast<double>(from)) / (static_cast<double>(steps) * cell);
    return std::clamp(rise, -3.99, 3.99);
  };
  const double slope_x = slope(owned.at(row, before(column)), owned.at(row, after(column)),
                               after(column) - before(column));
  const double slope_y =
      slope(owned.at(before(row), column), owned.at(after(row), column), after(row) - before(row));
  const double height = static_cast<double>(owned.at(row, column)) +
                        slope_x * (metres_x - (static_cast<double>(column) + 0.5) * cell) +
                        slope_y * (metres_y - (static_cast<double>(row) + 0.5) * cell);
  return (height - static_cast<double>(expected_ground)) * z_per_metre;
}

/// The parameter is the instruction set.
class CellPlanesOn : public testing::TestWithParam<std::string> {
 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, CellPlanesOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(CellPlanesOn, AreTheHeightsOfTheSurfaceToWithinAUnit) {
  std::mt19937 random(1);
  for (const float cell : {2.0f, 1.0f, 0.5f, 0.25f}) {
    for (const std::size_t width : {8U, 24U, 104U}) {
      // Steps between neighbours that give slopes up to 1 m/m, and some that are steeper.
      std::uniform_real_distribution<float> height(-0.5f * cell, 0.5f * cell);
      OwnedGrid grid(cell, width);
      for (float& value : grid.heights()) {
        value = expected_ground + (random() % 50 == 0 ? 10 : 1) * height(random);
      }
      const Planes planes(grid);
      const auto units = static_cast<std::uint32_t>(static_cast<float>(width) * cell) *
                         std::uint32_t{xy_per_metre};
      for (int i = 0; i < 3000; ++i) {
        const auto x = static_cast<std::int32_t>(random() % units);
        const auto y = static_cast<std::int32_t>(random() % units);
        ASSERT_NEAR(planes.at(x, y), naive(grid, x, y), 1.1)
            << "cell " << cell << ", width " << width << ", " << x << ", " << y;
      }
    }
  }
}

TEST_P(CellPlanesOn, OfATiltedPlaneAreExact) {
  OwnedGrid grid(1, 40);
  grid.set([](float x, float y) { return expected_ground + 0.25f * x - 0.5f * y; });
  const Planes planes(grid);
  for (std::int32_t y = 0; y < 40 * xy_per_metre; y += 61) {
    for (std::int32_t x = 0; x < 40 * xy_per_metre; x += 7) {
      ASSERT_NEAR(planes.at(x, y), naive(grid, x, y), 0.502) << x << ", " << y;
    }
  }
}

TEST_P(CellPlanesOn, LimitHeightsFarFromTheExpectedGround) {
  OwnedGrid grid(2, 8);
  grid.set([](float x, float) { return x < 0 ? 1e6f : -1e6f; });
  const Planes planes(grid);
  EXPECT_GT(planes.at(128, 128), 150 * z_per_metre);
  EXPECT_LT(planes.at(15 * 128, 128), -150 * z_per_metre);
}

}  // namespace
}  // namespace flagstone::surface
