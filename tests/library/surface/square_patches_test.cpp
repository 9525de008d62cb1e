// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/surface_config.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {
namespace {

SurfaceConfig config_of(float range, float sensor_height = 1.73f) {
  SurfaceConfig config;
  config.max_range = range;
  config.sensor_height = sensor_height;
  return config;
}

bool covers(const SquarePatch& patch, float x, float y) {
  const float half = patch.size / 2;
  return x >= patch.x - half && x < patch.x + half && y >= patch.y - half && y < patch.y + half;
}

TEST(SquarePatches, CoverEverythingOnceExceptTheBlindCentre) {
  for (const float range : {8.0f, 23.0f, 40.0f, 100.0f}) {
    for (const float height : {0.1f, 1.2f, 1.73f, 4.0f}) {
      const SurfaceConfig config = config_of(range, height);
      const SquareCells cells(config);
      const SquarePatches patches(config, cells);
      for (float y = -cells.extent() + 1; y < cells.extent(); y += 2) {
        for (float x = -cells.extent() + 1; x < cells.extent(); x += 2) {
          int covering = 0;
          for (const SquarePatch& patch : patches.list()) covering += covers(patch, x, y) ? 1 : 0;
          ASSERT_LE(covering, 1) << x << ", " << y;
          // Patches with centres within twice the height are omitted.
          if (std::hypot(x, y) > 2 * height + 2.9f) {
            ASSERT_EQ(covering, 1) << x << ", " << y;
          }
          if (height > 1 && std::hypot(x, y) < 0.5f) {
            ASSERT_EQ(covering, 0);
          }
        }
      }
    }
  }
}

TEST(SquarePatches, UseTheDefaultHeightIfTheOriginIsNotInTheSensor) {
  const auto count = [](float height) {
    const SurfaceConfig config = config_of(40, height);
    return SquarePatches(config, SquareCells(config)).list().size();
  };
  EXPECT_GT(count(0.1f), count(1.73f));
  for (const float height : {0.0f, -1.0f, -50.0f}) EXPECT_EQ(count(height), count(1.73f));
}

TEST(SquarePatches, AreSortedNearestFirst) {
  const SquareCells cells{SurfaceConfig{}};
  const SquarePatches patches({}, cells);

  for (std::size_t i = 1; i < patches.list().size(); ++i) {
    const SquarePatch& before = patches.list()[i - 1];
    const SquarePatch& patch = patches.list()[i];
    EXPECT_LE(std::hypot(before.x, before.y), std::hypot(patch.x, patch.y) + 1e-4f);
  }
}

TEST(SquarePatches, AreSmallWithin24MetresAndLargeBeyond) {
  const SquareCells cells{SurfaceConfig{}};
  const SquarePatches patches({}, cells);

  for (const SquarePatch& patch : patches.list()) {
    const bool is_near = std::max(std::abs(patch.x), std::abs(patch.y)) < 24;
    EXPECT_EQ(patch.size, is_near ? 4.0f : 8.0f) << patch.x << ", " << patch.y;
    EXPECT_EQ(patch.size_class, is_near ? 0 : 1);
    EXPECT_EQ(patch.x, (static_cast<float>(patch.column) + 0.5f) * patch.size - cells.extent());
    EXPECT_EQ(patch.y, (static_cast<float>(patch.row) + 0.5f) * patch.size - cells.extent());
  }
}

TEST(SquarePatches, ContainTheCellsOfTheirSquare) {
  const SquareCells cells{SurfaceConfig{}};
  const SquarePatches patches({}, cells);
  std::vector<bool> taken(cells.cell_count());

  for (const SquarePatch& patch : patches.list()) {
    const auto column = static_cast<int>((patch.x + cells.extent()) / block_size);
    const auto row = static_cast<int>((patch.y + cells.extent()) / block_size);
    const CellRange block = cells.block(column, row);
    EXPECT_GE(patch.cells.first, block.first);
    EXPECT_LE(patch.cells.last, block.last);
    const auto side = static_cast<std::uint32_t>(patch.size) *
                      static_cast<std::uint32_t>(32 >> cells.block_class(column, row)) /
                      static_cast<std::uint32_t>(block_size);
    EXPECT_EQ(patch.cells.last - patch.cells.first, side * side);
    for (std::uint32_t cell = patch.cells.first; cell < patch.cells.last; ++cell) {
      EXPECT_FALSE(taken[cell]);
      taken[cell] = true;
    }
  }
}

TEST(SquarePatches, ContainTheCoarseCellsOfTheirSquare) {
  const SquareCells cells{SurfaceConfig{}};
  const SquarePatches patches({}, cells);

  for (const SquarePatch& patch : patches.list()) {
    const std::uint32_t first = patch.coarse.first % coarse_cells_of_block;
    const std::uint32_t count = patch.coarse.last - patch.coarse.first;
    EXPECT_EQ(count, patch.size == 4 ? 4U : 16U);
    EXPECT_EQ(first % count, 0U);
    const CellRange block = cells.blocks()[patch.coarse.first / coarse_cells_of_block];
    const std::uint32_t each = (block.last - block.first) / coarse_cells_of_block;
    EXPECT_EQ(patch.cells.first, block.first + first * each);
    EXPECT_EQ(patch.cells.last, block.first + (first + count) * each);
  }
}

}  // namespace
}  // namespace flagstone::surface
