// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/bin_groups.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "forced_target.hpp"
#include "library/plane_fits/sorted_scan.hpp"
#include "random_cloud.hpp"

namespace flagstone::plane_fits {
namespace {

using patchwork::ConcentricZones;
using patchwork::read_chunk;

using Lists = std::vector<std::vector<std::uint32_t>>;  ///< indices of the points of each bin

/// The points of each bin in input order, found point by point.
Lists naive(const ScanPoints& scan, std::size_t points, const ConcentricZones& zones) {
  std::vector<std::uint32_t> bins(points);
  zones.locate(scan.x(), scan.y(), scan.z(), points, bins.data());
  Lists lists(zones.group_count());
  for (std::uint32_t i = 0; i < points; ++i) lists.at(bins[i]).push_back(i);
  return lists;
}

/// The points of each bin in input order, according to the groups.
Lists listed(const BinGroups& groups, std::uint32_t group_count) {
  Lists lists(group_count);
  for (std::uint32_t bin = 0; bin < group_count; ++bin) lists[bin] = tests::points_of(groups, bin);
  return lists;
}

std::vector<Point> shuffled(std::vector<Point> cloud) {
  std::ranges::shuffle(cloud, std::mt19937(1));
  return cloud;
}

TEST(BinGroups, ContainEveryPointOfEveryBinInInputOrder) {
  EXPECT_TRUE(rc::check([] {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 200),
                                      rc::gen::inRange<std::size_t>(8000, 20000));
    const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1000);
    std::vector<Point> cloud = tests::corrupted_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = tests::random_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = shuffled(std::move(cloud));

    const tests::SortedScan sorted(cloud, {});

    RC_TAG(sorted.groups.moved() ? "moved" : "runs");
    const Lists expected = naive(sorted.scan, size, sorted.zones);
    RC_ASSERT(listed(sorted.groups, sorted.zones.group_count()) == expected);
    for (std::uint32_t bin = 0; bin < expected.size(); ++bin) {
      RC_ASSERT(sorted.groups.size(bin) == expected[bin].size());
    }
  }));
}

TEST(BinGroups, OfAnOrderedScanAreRuns) {
  EXPECT_FALSE(tests::SortedScan(tests::random_cloud(100000, 1), {}).groups.moved());
}

TEST(BinGroups, OfAnUnorderedCloudAreMovedPoints) {
  EXPECT_TRUE(tests::SortedScan(shuffled(tests::random_cloud(100000, 1)), {}).groups.moved());
}

/// Points in two opposite bins: `run_length` points in each, alternately.
std::vector<Point> by_turns(std::size_t points, std::size_t run_length) {
  std::vector<Point> cloud;
  cloud.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    cloud.push_back({i / run_length % 2 == 0 ? 5.0f : -5.0f, 0.5f, -1.7f});
  }
  return cloud;
}

TEST(BinGroups, AreCorrectIfRunsAreJustLongEnoughToKeep) {
  // Memory is reserved for runs of four points; chunks of 8,192 points end between runs.
  for (const std::size_t run_length : {1U, 3U, 4U, 5U}) {
    const std::vector<Point> cloud = by_turns(40000, run_length);

    const tests::SortedScan sorted(cloud, {});

    EXPECT_EQ(sorted.groups.moved(), run_length < 4) << run_length;
    EXPECT_EQ(listed(sorted.groups, sorted.zones.group_count()),
              naive(sorted.scan, cloud.size(), sorted.zones))
        << run_length;
  }
}

TEST(BinGroups, DoNotDependOnThePreviousScan) {
  const std::vector<Point> first = shuffled(tests::corrupted_cloud(20000, 2));
  const std::vector<Point> second = tests::random_cloud(9000, 3);
  tests::SortedScan sorted(first, {});

  for (std::size_t i = 0; i < chunk_count(second.size()); ++i) {
    read_chunk(tests::view_of(second), i, sorted.zones, sorted.scan);
  }
  sorted.groups.group(sorted.scan, second.size(), sorted.zones.group_count());

  EXPECT_EQ(listed(sorted.groups, sorted.zones.group_count()),
            naive(sorted.scan, second.size(), sorted.zones));
}

/// Any way of finding bins: square cells, in any number. The parameter is the instruction set.
class BinGroupsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, BinGroupsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

/// The points of each cell in input order, found point by point.
Lists naive(const std::vector<Point>& cloud, const tests::SquareCells& cells) {
  Lists lists(cells.group_count());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) lists[cells.cell_of(cloud[i])].push_back(i);
  return lists;
}

TEST_P(BinGroupsOn, ContainEveryPointOfEverySquareCellInInputOrder) {
  EXPECT_TRUE(rc::check([] {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 200),
                                      rc::gen::inRange<std::size_t>(8000, 20000));
    const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1000);
    std::vector<Point> cloud = *rc::gen::arbitrary<bool>() ? tests::corrupted_cloud(size, seed)
                                                           : tests::random_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = shuffled(std::move(cloud));
    // Bins that are mostly full, a tenth full, and nearly empty.
    const auto cells = *rc::gen::element(tests::SquareCells{.cell = 20, .width = 5},
                                         tests::SquareCells{.cell = 1, .width = 100},
                                         tests::SquareCells{.cell = 0.25f, .width = 511});

    const tests::CellPoints grouped(cloud, cells);

    const Lists expected = naive(cloud, cells);
    RC_TAG(grouped.groups.moved() ? "moved" : "runs");
    RC_ASSERT(listed(grouped.groups, cells.group_count()) == expected);
    for (std::uint32_t bin = 0; bin < cells.group_count(); ++bin) {
      RC_ASSERT(grouped.groups.size(bin) == expected[bin].size());
    }
  }));
}

TEST_P(BinGroupsOn, MovedPointsKeepTheirCoordinatesBitForBit) {
  const std::vector<Point> cloud = shuffled(tests::corrupted_cloud(20000, 9));

  const tests::CellPoints grouped(cloud, {.cell = 0.5f, .width = 300});

  ASSERT_TRUE(grouped.groups.moved());
  std::size_t moved = 0;
  for (std::uint32_t bin = 0; bin < grouped.cells.group_count(); ++bin) {
    for (const MovedPoint& point : grouped.groups.points(bin)) {
      const Point& original = cloud[point.index];
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.x), std::bit_cast<std::uint32_t>(original.x));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.y), std::bit_cast<std::uint32_t>(original.y));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.z), std::bit_cast<std::uint32_t>(original.z));
      ++moved;
    }
  }
  EXPECT_EQ(moved, cloud.size());
}

TEST_P(BinGroupsOn, DoNotDependOnThePreviousScanWithOtherBins) {
  const std::vector<Point> first = shuffled(tests::corrupted_cloud(20000, 2));
  tests::CellPoints grouped(first, {.cell = 1, .width = 150});
  // Fewer bins, then more than any previous scan, then fewer again.
  for (const tests::SquareCells& cells :
       {tests::SquareCells{.cell = 2, .width = 40}, tests::SquareCells{.cell = 0.5f, .width = 400},
        tests::SquareCells{.cell = 5, .width = 10}}) {
    const std::vector<Point> cloud = tests::random_cloud(9000, cells.width);
    grouped.cells = cells;

    grouped.group(cloud);

    EXPECT_EQ(listed(grouped.groups, cells.group_count()), naive(cloud, cells));
  }
}

}  // namespace
}  // namespace flagstone::plane_fits
