// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/square_cells.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "flagstone/surface.hpp"
#include "forced_target.hpp"
#include "guarded_memory.hpp"
#include "library/core/simd_target.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/surface/vector_functions.hpp"
#include "random_cloud.hpp"

namespace flagstone::surface {
namespace {

constexpr std::array<float, 9> ranges = {8, 9, 16, 24, 24.1f, 40, 63, 100, 200};

SurfaceConfig with_range(float range) {
  SurfaceConfig config;
  config.max_range = range;
  return config;
}

/// Side of the cells at a position, metres: the finest level that covers it.
float side_at(double x, double y) {
  // Levels cover whole blocks, so the start of the block decides.
  const double reach = std::max(std::floor(std::abs(x < 0 ? -x - 1e-12 : x) / 8),
                                std::floor(std::abs(y < 0 ? -y - 1e-12 : y) / 8)) *
                       8;
  float side = levels[0].cell;
  for (const Level& level : levels) {
    if (reach < static_cast<double>(level.reach)) side = level.cell;
  }
  return side;
}

/// The cell of a position, from block(), side_at() and the Z-order.
std::uint32_t naive_cell(const SquareCells& cells, double x, double y) {
  const auto edge = static_cast<double>(cells.extent());
  const auto block_of = [&](double v) { return static_cast<int>(std::floor((v + edge) / 8)); };
  const CellRange block = cells.block(block_of(x), block_of(y));
  const auto inside = [&](double v) { return v + edge - 8 * block_of(v); };
  const auto side = static_cast<double>(side_at(x, y));
  return block.first + z_order(static_cast<std::uint32_t>(inside(x) / side),
                               static_cast<std::uint32_t>(inside(y) / side));
}

/// All cells that a point can have within the rounding of its coordinates, 1e-4 m.
std::vector<std::uint32_t> allowed_cells(const SquareCells& cells, const Point& p) {
  std::vector<std::uint32_t> allowed;
  const auto most = static_cast<double>(cells.extent()) - 1e-6;
  for (const double dx : {-1e-4, 0.0, 1e-4}) {
    for (const double dy : {-1e-4, 0.0, 1e-4}) {
      allowed.push_back(naive_cell(cells, std::clamp(static_cast<double>(p.x) + dx, -most, most),
                                   std::clamp(static_cast<double>(p.y) + dy, -most, most)));
    }
  }
  return allowed;
}

/// The parameter is the instruction set.
class SquareCellsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, SquareCellsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SquareCellsOn, FindTheCellOfAPoint) {
  EXPECT_TRUE(rc::check([] {
    const float range = *rc::gen::elementOf(ranges);
    const SquareCells cells(with_range(range));
    const auto most = static_cast<int>(range * 1000);
    std::vector<Point> cloud;
    for (int i = 0; i < 40; ++i) {
      // Millimetres, or quarters of a metre, which are edges of cells, blocks and levels.
      const auto millimetres = *rc::gen::inRange(-most, most);
      const auto quarters = *rc::gen::inRange(-most / 250, most / 250);
      const bool on_edges = *rc::gen::arbitrary<bool>();
      cloud.push_back(
          {on_edges ? static_cast<float>(quarters) / 4 : static_cast<float>(millimetres) / 1000,
           static_cast<float>(*rc::gen::inRange(-most, most)) / 1000, -1.5f});
    }

    const std::vector<std::uint32_t> found = tests::cells_of(cloud, cells);

    RC_ASSERT(found.size() == cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (std::hypot(cloud[i].x, cloud[i].y) > range - 1e-3f) continue;
      const std::vector<std::uint32_t> allowed = allowed_cells(cells, cloud[i]);
      RC_ASSERT(std::ranges::count(allowed, found[i]) > 0);
    }
  }));
}

TEST_P(SquareCellsOn, EveryPointInRangeHasACellEvenAtTheLimit) {
  for (const float range : ranges) {
    const SquareCells cells(with_range(range));
    const float last = std::nextafter(range, 0.0f);
    std::vector<Point> cloud;
    for (const float v : {last, std::nextafter(last, 0.0f), 0.9999999f * range}) {
      for (const float w : {0.0f, 1e-30f, -1e-30f, 1e-4f, -1e-4f}) {
        for (const Point& p :
             {Point{v, w, -1}, Point{-v, w, -1}, Point{w, v, -1}, Point{w, -v, -1}}) {
          cloud.push_back(p);
        }
      }
    }

    const std::vector<std::uint32_t> found = tests::cells_of(cloud, cells);

    ASSERT_EQ(found.size(), cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (found[i] == cells.none()) continue;
      const std::vector<std::uint32_t> allowed = allowed_cells(cells, cloud[i]);
      EXPECT_GT(std::ranges::count(allowed, found[i]), 0)
          << "range " << range << ", (" << cloud[i].x << ", " << cloud[i].y << "), cell "
          << found[i] << " of " << cells.cell_count();
    }
  }
}

TEST_P(SquareCellsOn, InvalidPointsPointsOutOfRangeAndNoiseHaveNoCell) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const SquareCells cells{SurfaceConfig{}};
  const std::vector<Point> without = {{0, 0, 0},
                                      {-0.0f, 0, -0.0f},
                                      {nan, 5, 1},
                                      {5, nan, 1},
                                      {5, 5, nan},
                                      {inf, 5, 1},
                                      {5, -inf, 1},
                                      {5, 5, -inf},
                                      {1e30f, 5, 1},
                                      {5, -3e38f, 1},
                                      {5, 5, 3e38f},
                                      {5, 5, 10001},
                                      {5, 5, -10001},
                                      {100, 0, 1},
                                      {-71, 71, 1},
                                      // Noise limit at 10 m: -1.73 - 2 - 0.35 * 10.
                                      {10, 0, -7.24f},
                                      {0, -10, -9999}};
  const std::vector<Point> with = {{10, 0, -7.22f}, {1e-40f, 0, 0}, {5, 5, 9999}, {99.9f, 0, 1}};
  for (const Point& point : without) {
    // Alone, and next to points with a cell.
    EXPECT_EQ(tests::cells_of({point}, cells).front(), cells.none()) << point.x << ", " << point.z;
    std::vector<Point> cloud(20, Point{5, 5, 1});
    cloud[7] = point;
    const std::vector<std::uint32_t> found = tests::cells_of(cloud, cells);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      EXPECT_EQ(found[i] == cells.none(), i == 7) << point.x << ", " << point.z << ": " << i;
    }
  }
  for (const std::uint32_t cell : tests::cells_of(with, cells)) EXPECT_LT(cell, cells.none());
}

TEST_P(SquareCellsOn, EveryFloatValueHasACellOrNone) {
  const SquareCells cells{SurfaceConfig{}};
  EXPECT_TRUE(rc::check([&](const std::vector<std::array<std::uint32_t, 3>>& bits) {
    std::vector<Point> cloud(bits.size());
    std::ranges::transform(bits, cloud.begin(), [](const std::array<std::uint32_t, 3>& xyz) {
      return std::bit_cast<Point>(xyz);
    });

    const std::vector<std::uint32_t> found = tests::cells_of(cloud, cells);

    RC_ASSERT(found.size() == cloud.size());
    for (const std::uint32_t cell : found) RC_ASSERT(cell < cells.group_count());
  }));
}

TEST_P(SquareCellsOn, ReadNothingPastTheirTables) {
  const tests::GuardedMemory memory(sizeof(SquareCells));
  const SquareCells* const cells =
      new (memory.last(sizeof(SquareCells)).data()) SquareCells(SurfaceConfig{});

  const std::vector<std::uint32_t> found = tests::cells_of(tests::random_cloud(1000, 1), *cells);

  EXPECT_EQ(found, tests::cells_of(tests::random_cloud(1000, 1), SquareCells(SurfaceConfig{})));
  std::destroy_at(cells);
}

TEST(SquareCells, BlocksHaveDistinctNumbers) {
  for (const float range : ranges) {
    const SquareCells cells(with_range(range));
    std::vector<bool> taken(cells.cell_count());
    for (int row = 0; row < 2 * cells.half_blocks(); ++row) {
      for (int column = 0; column < 2 * cells.half_blocks(); ++column) {
        const auto [first, last] = cells.block(column, row);
        const int along = 32 >> cells.block_class(column, row);
        ASSERT_EQ(last - first, static_cast<std::uint32_t>(along * along));
        ASSERT_LE(last, cells.cell_count());
        for (std::uint32_t cell = first; cell < last; ++cell) {
          ASSERT_FALSE(taken[cell]) << "range " << range << ", cell " << cell;
          taken[cell] = true;
        }
      }
    }
  }
}

TEST(SquareCells, ListTheirBlocksRowByRow) {
  const SquareCells cells(with_range(40));

  std::size_t i = 0;
  for (int row = 0; row < 2 * cells.half_blocks(); ++row) {
    for (int column = 0; column < 2 * cells.half_blocks(); ++column) {
      EXPECT_EQ(cells.blocks()[i].first, cells.block(column, row).first);
      EXPECT_EQ(cells.blocks()[i].last, cells.block(column, row).last);
      ++i;
    }
  }
  EXPECT_EQ(cells.blocks().size(), i);
}

TEST(SquareCells, NumbersFitIntoBinsAtEveryRange) {
  for (float range = 8; range <= 200; range += 0.5f) {
    EXPECT_LT(SquareCells(with_range(range)).group_count(), 1U << plane_fits::bin_bits) << range;
  }
}

TEST(SquareCells, HaveTheSizeOfTheFinestLevelThatCoversThem) {
  const SquareCells cells{SurfaceConfig{}};
  const int half = cells.half_blocks();

  for (int row = 0; row < 2 * half; ++row) {
    for (int column = 0; column < 2 * half; ++column) {
      const double x = 8.0 * (column - half) + 4;
      const double y = 8.0 * (row - half) + 4;
      const float side = 8.0f / static_cast<float>(32 >> cells.block_class(column, row));
      EXPECT_EQ(side, side_at(x, y)) << x << ", " << y;
    }
  }
}

TEST(SquareCells, CoverTheRangeInWholeBlocks) {
  for (const float range : ranges) {
    const float extent = SquareCells(with_range(range)).extent();
    EXPECT_GE(extent, range);
    EXPECT_LT(extent, range + 8.001f);
    EXPECT_EQ(std::fmod(extent, 8.0f), 0);
  }
}

TEST(ZOrder, EveryAlignedSquareIsAContiguousRange) {
  for (std::uint32_t side = 1; side <= 32; side *= 2) {
    for (std::uint32_t row = 0; row < 32; row += side) {
      for (std::uint32_t column = 0; column < 32; column += side) {
        const std::uint32_t first = z_order(column, row);
        EXPECT_EQ(first % (side * side), 0U);
        for (std::uint32_t y = row; y < row + side; ++y) {
          for (std::uint32_t x = column; x < column + side; ++x) {
            EXPECT_EQ(z_order(x, y) / (side * side), first / (side * side));
          }
        }
      }
    }
  }
}

TEST(ZOrder, NumbersEveryCellOnce) {
  std::vector<bool> taken(1024);
  for (std::uint32_t row = 0; row < 32; ++row) {
    for (std::uint32_t column = 0; column < 32; ++column) {
      const std::uint32_t index = z_order(column, row);
      ASSERT_LT(index, 1024U);
      EXPECT_FALSE(taken[index]);
      taken[index] = true;
    }
  }
}

}  // namespace
}  // namespace flagstone::surface
