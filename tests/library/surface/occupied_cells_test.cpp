// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/occupied_cells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone::surface {
namespace {

/// First point, number of points and index in the grid of a cell.
using Cell = std::array<std::uint32_t, 3>;

std::vector<Cell> cells_of(const OccupiedCells& cells) {
  std::vector<Cell> found;
  for (std::size_t i = 0; i < cells.size; ++i) {
    found.push_back({cells.firsts[i], cells.counts[i], cells.places[i]});
  }
  return found;
}

/// The parameter is the instruction set.
class CellListsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, CellListsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(CellListsOn, ContainCellsWithThreePointsOrMoreBySize) {
  std::mt19937 random(1);
  for (const std::uint32_t along : {4U, 8U, 16U, 32U}) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < along * along; ++i) places.push_back(3 * i);
    std::vector<LevelBlock> blocks;
    std::vector<std::uint32_t> begins = {0};
    std::array<std::vector<Cell>, cell_sizes> expected;
    for (const std::uint32_t step : {1U, 4U, 1U, 16U}) {
      const std::uint32_t first_place = 5000 * step;
      blocks.push_back({.first_cell = static_cast<std::uint32_t>(begins.size() - 1),
                        .step = step,
                        .first_place = first_place});
      const std::uint32_t most = blocks.size() == 3 ? 1 : 60 / step;  // the third block is empty
      for (std::uint32_t i = 0; i < along * along; ++i) {
        const std::uint32_t first = begins.back();
        // Most neighbours of cells without points have none either.
        const bool is_empty = i / 16 % 3 == 1;
        for (std::uint32_t k = 0; k < step; ++k) {
          begins.push_back(begins.back() +
                           (is_empty ? 0 : static_cast<std::uint32_t>(random() % most)));
        }
        const std::uint32_t count = begins.back() - first;
        if (count < 3) continue;
        const std::size_t size = count <= small_cell ? 0 : count <= medium_cell ? 1 : 2;
        expected[size].push_back({first, count, first_place + places[i]});
      }
    }

    CellLists lists;
    lists.reserve(4 * places.size());
    for (int repeat = 0; repeat < 2; ++repeat) {
      lists.list(blocks, places, begins.data());
      for (std::size_t size = 0; size < cell_sizes; ++size) {
        EXPECT_EQ(cells_of(lists.cells(static_cast<CellSize>(size))), expected[size]);
        EXPECT_FALSE(expected[size].empty());
      }
    }
  }
}

TEST(OccupiedCellsTest, APartEndsWithTheLastCell) {
  const std::array<std::uint32_t, 3> numbers = {1, 2, 3};
  const OccupiedCells cells{.firsts = numbers.data(),
                            .counts = numbers.data(),
                            .places = numbers.data(),
                            .size = numbers.size()};

  EXPECT_EQ(cells_of(cells.part(1, 2)), (std::vector<Cell>{{2, 2, 2}, {3, 3, 3}}));
  EXPECT_EQ(cells_of(cells.part(2, 2)), (std::vector<Cell>{{3, 3, 3}}));
}

}  // namespace
}  // namespace flagstone::surface
