// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/packed_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/square_scan.hpp"
#include "library/surface/vector_functions.hpp"
#include "numbers.hpp"

namespace flagstone::surface {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;

/// A packed point as lengths, metres.
struct Unpacked {
  explicit Unpacked(PackedPoint point)
      : x((point & 0xFFU) / double{xy_per_metre}),
        y((point >> 8U & 0xFFU) / double{xy_per_metre}),
        z((static_cast<std::int32_t>(point) >> 16) / double{z_per_metre}) {}
  double x, y;  ///< from the corner of a cell of 2 m
  double z;     ///< above SquareCells::packed_zero()
};

/// The points of each cell, found point by point, in input order.
std::vector<std::vector<PackedPoint>> naive(const std::vector<Point>& cloud,
                                            const SquareCells& cells) {
  std::vector<std::vector<PackedPoint>> lists(cells.group_count());
  for (const tests::Located& point : tests::located(cloud, cells)) {
    lists[point.cell].push_back(point.packed);
  }
  return lists;
}

/// The parameter is the instruction set.
class PackedPointsOn : public testing::TestWithParam<std::string> {
 protected:
  static void expect_sorted(const std::vector<Point>& cloud, const tests::SquareScan& scan) {
    const std::vector<std::vector<PackedPoint>> expected = naive(cloud, scan.cells);
    std::uint32_t first = 0;
    for (std::uint32_t cell = 0; cell < scan.cells.cell_count(); ++cell) {
      const std::span<const PackedPoint> held = scan.points.points(cell, cell + 1);
      ASSERT_EQ(std::vector(held.begin(), held.end()), expected[cell]) << cell;
      ASSERT_EQ(scan.points.begins()[cell], first);
      first += static_cast<std::uint32_t>(held.size());
    }
    ASSERT_EQ(scan.points.begins()[scan.cells.none()], first);
    ASSERT_EQ(first + expected.back().size(), cloud.size());
  }

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, PackedPointsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(PackedPointsOn, AreSortedByCellAndInInputOrderWithinACell) {
  for (const std::size_t size : {1U, 15U, 16U, 17U, 1000U, 8192U, 8193U, 40000U}) {
    for (std::vector<Point> cloud : {random_cloud(size, 1), corrupted_cloud(size, 2)}) {
      expect_sorted(cloud, tests::SquareScan(cloud));
      std::ranges::shuffle(cloud, std::mt19937(3));
      expect_sorted(cloud, tests::SquareScan(cloud));
    }
  }
}

TEST_P(PackedPointsOn, DoNotDependOnThePreviousScan) {
  tests::SquareScan scan(corrupted_cloud(30000, 4));
  for (const std::uint32_t seed : {5U, 6U}) {
    const std::vector<Point> cloud = random_cloud(9000, seed);

    scan.read(cloud);

    expect_sorted(cloud, scan);
  }
}

TEST_P(PackedPointsOn, ContainPositionsRoundedDownAndHeightsRounded) {
  for (const float sensor_height : {1.73f, 0.0f, -2.5f, 40.0f}) {
    const SurfaceConfig config{.sensor_height = sensor_height};
    const SquareCells cells(config);
    std::vector<Point> cloud = random_cloud(20000, 7);
    for (std::size_t i = 0; i < cloud.size(); i += 3) {  // on positions where coordinates round
      cloud[i].x = std::round(cloud[i].x * 128) / 128;
      cloud[i].z = std::round(cloud[i].z * 1024) / 1024;
    }
    const std::vector<tests::Located> found = tests::located(cloud, cells);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (found[i].cell == cells.none()) continue;
      const Unpacked unpacked(found[i].packed);
      // Single precision may move a coordinate across the limit of a unit.
      constexpr double rounding = 3e-5;
      const auto below = [&](float coordinate, double packed) {
        const double from_edge = double{coordinate} + double{cells.extent()};
        return std::remainder(from_edge - packed - 1.0 / 256, packed_cell) + 1.0 / 256;
      };
      ASSERT_GE(below(cloud[i].x, unpacked.x), -rounding) << i;
      ASSERT_LT(below(cloud[i].x, unpacked.x), 1.0 / xy_per_metre + rounding) << i;
      ASSERT_GE(below(cloud[i].y, unpacked.y), -rounding) << i;
      ASSERT_LT(below(cloud[i].y, unpacked.y), 1.0 / xy_per_metre + rounding) << i;
      ASSERT_NEAR(unpacked.z, double{cloud[i].z} - double{cells.packed_zero()},
                  0.5 / z_per_metre + 1e-5);
    }
  }
}

TEST(PackedZero, IsNearTheExpectedGroundButDoesNotChangeWithIt) {
  const auto zero_at = [](float sensor_height) {
    return SquareCells(SurfaceConfig{.sensor_height = sensor_height}).packed_zero();
  };
  EXPECT_EQ(zero_at(1.73f), 0);
  EXPECT_EQ(zero_at(-15.9f), 0);
  EXPECT_EQ(zero_at(40.0f), -32);
  EXPECT_EQ(zero_at(-100.0f), 96);
}

TEST_P(PackedPointsOn, PositionsOnTheLatticeAreExact) {
  const SquareCells cells{SurfaceConfig{}};
  std::vector<Point> cloud;
  for (int i = -200; i < 200; ++i) {
    const float x = 60 + static_cast<float>(i) / xy_per_metre;
    cloud.push_back({x, -x, static_cast<float>(i) / 256});
  }
  const std::vector<tests::Located> found = tests::located(cloud, cells);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Unpacked unpacked(found[i].packed);
    EXPECT_EQ(unpacked.x, std::fmod(double{cloud[i].x} + double{cells.extent()}, packed_cell));
    EXPECT_EQ(unpacked.y, std::fmod(double{cloud[i].y} + double{cells.extent()}, packed_cell));
  }
}

TEST_P(PackedPointsOn, HeightsAreLimitedTo64MetresAboveAndBelowThePackedZero) {
  SurfaceConfig config;
  config.noise_depth = 1000;
  const SquareCells cells(config);

  const auto height_of = [&](float above) {
    return Unpacked(tests::located({{10, 10, cells.packed_zero() + above}}, cells)[0].packed).z;
  };

  EXPECT_EQ(height_of(0), 0);
  EXPECT_NEAR(height_of(63.9f), 63.9, 1e-3);
  EXPECT_NEAR(height_of(-63.9f), -63.9, 1e-3);
  for (const float far : {64.0f, 65.0f, 500.0f, 1000.0f}) {
    EXPECT_EQ(height_of(far), 64 - 1.0 / z_per_metre) << far;
    EXPECT_EQ(height_of(-far), -64) << far;
  }
}

TEST_P(PackedPointsOn, AnyOrderGivesTheSamePointsPerCell) {
  std::vector<Point> cloud = corrupted_cloud(20000, 8);
  const auto per_cell = [](const tests::SquareScan& scan) {
    std::vector<std::vector<PackedPoint>> lists;
    for (std::uint32_t cell = 0; cell < scan.cells.cell_count(); ++cell) {
      const std::span<const PackedPoint> held = scan.points.points(cell, cell + 1);
      std::ranges::sort(lists.emplace_back(held.begin(), held.end()));
    }
    return lists;
  };
  const std::vector<std::vector<PackedPoint>> expected = per_cell(tests::SquareScan(cloud));
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    std::ranges::shuffle(cloud, std::mt19937(seed));

    EXPECT_EQ(per_cell(tests::SquareScan(cloud)), expected);
  }
}

TEST_P(PackedPointsOn, AreTheSameOnEveryInstructionSet) {
  const std::vector<Point> cloud = corrupted_cloud(20000, 9);
  const SquareCells cells{SurfaceConfig{}};
  const std::vector<tests::Located> expected = tests::located(cloud, cells);
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget other(target);
    const std::vector<tests::Located> found = tests::located(cloud, cells);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_EQ(found[i].cell, expected[i].cell) << target << ", point " << i;
      if (found[i].cell == cells.none()) continue;
      ASSERT_EQ(found[i].packed, expected[i].packed) << target << ", point " << i;
    }
  }
}

TEST_P(PackedPointsOn, VectorsWithAPointWithoutACellAreUnusual) {
  const std::vector<Point> usual(8192 + 64, Point{10, 10, -1.5f});
  const std::size_t length = tests::vector_length();
  const auto is_marked = [&](const tests::SquareScan& scan, std::size_t point) {
    return scan.points.unusual()[point / length * length / 4] != 0;
  };
  const tests::SquareScan scan(usual);
  for (std::size_t i = 0; i < usual.size(); ++i) ASSERT_FALSE(is_marked(scan, i)) << i;
  for (const std::size_t at : {0U, 1U, 2U, 3U, 4U, 15U, 16U, 100U, 8191U, 8192U, 8192U + 63}) {
    for (const Point& bad : {Point{nan, 1, 1}, Point{500, 0, 0}, Point{10, 10, -500}}) {
      std::vector<Point> cloud = usual;
      cloud[at] = bad;

      const tests::SquareScan unusual(cloud);

      EXPECT_TRUE(is_marked(unusual, at)) << at;
      const std::size_t together = std::max(length, std::size_t{4});
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (i / together == at / together) continue;
        ASSERT_FALSE(is_marked(unusual, i)) << at << ", " << i;
      }
    }
  }
}

}  // namespace
}  // namespace flagstone::surface
