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
#include <span>
#include <string>
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

  for (std::size_t i = 0; i < ScanPoints::chunk_count(second.size()); ++i) {
    read_chunk(tests::view_of(second), i, sorted.zones, sorted.scan);
  }
  sorted.groups.group(sorted.scan, second.size(), sorted.zones.group_count());

  EXPECT_EQ(listed(sorted.groups, sorted.zones.group_count()),
            naive(sorted.scan, second.size(), sorted.zones));
}

/// Properties that must not depend on how points are moved. The parameter is the instruction set.
class MovedPointsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, MovedPointsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

/// The indices of the points in the order of their cells, and the index of the first point of each
/// cell.
struct NaiveOrder {
  explicit NaiveOrder(const std::vector<Point>& cloud, const tests::SquareCells& cells) {
    Lists lists(cells.group_count());
    for (std::uint32_t i = 0; i < cloud.size(); ++i) lists[cells.cell_of(cloud[i])].push_back(i);
    for (const std::vector<std::uint32_t>& list : lists) {
      firsts.push_back(indices.size());
      indices.insert(indices.end(), list.begin(), list.end());
    }
    firsts.push_back(indices.size());
  }

  /// The points of the cells `begin` to `end` - 1.
  [[nodiscard]] std::vector<std::uint32_t> range(std::uint32_t begin, std::uint32_t end) const {
    const auto at = [&](std::size_t i) {
      return indices.begin() + static_cast<std::ptrdiff_t>(firsts[i]);
    };
    return {at(begin), at(end)};
  }

  std::vector<std::uint32_t> indices;
  std::vector<std::size_t> firsts;
};

std::vector<std::uint32_t> indices_of(std::span<const MovedPoint> points) {
  std::vector<std::uint32_t> indices;
  for (const MovedPoint& point : points) indices.push_back(point.index);
  return indices;
}

TEST_P(MovedPointsOn, OfARangeOfBinsAreContiguousInInputOrderPerBin) {
  EXPECT_TRUE(rc::check([] {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 200),
                                      rc::gen::inRange<std::size_t>(8000, 20000));
    const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1000);
    std::vector<Point> cloud = *rc::gen::arbitrary<bool>() ? tests::corrupted_cloud(size, seed)
                                                           : tests::random_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = shuffled(std::move(cloud));
    // Blocks of bins that are mostly full, a tenth full, and nearly empty.
    const auto cells = *rc::gen::element(tests::SquareCells{.cell = 20, .width = 5},
                                         tests::SquareCells{.cell = 1, .width = 100},
                                         tests::SquareCells{.cell = 0.25f, .width = 511});

    const tests::CellPoints moved(cloud, cells);

    const NaiveOrder expected(cloud, cells);
    const std::uint32_t groups = cells.group_count();
    RC_ASSERT(moved.groups.moved());
    RC_ASSERT(indices_of(moved.groups.points(0, groups)) == expected.indices);
    for (std::uint32_t bin = 0; bin < groups; ++bin) {
      RC_ASSERT(moved.groups.size(bin) == expected.firsts[bin + 1] - expected.firsts[bin]);
    }
    for (int repeat = 0; repeat < 20; ++repeat) {
      const auto begin = *rc::gen::inRange<std::uint32_t>(0, groups + 1);
      const auto end = *rc::gen::inRange<std::uint32_t>(begin, groups + 1);
      RC_ASSERT(indices_of(moved.groups.points(begin, end)) == expected.range(begin, end));
    }
  }));
}

TEST_P(MovedPointsOn, KeepTheirCoordinatesBitForBit) {
  for (std::vector<Point> cloud :
       {tests::corrupted_cloud(20000, 8), shuffled(tests::corrupted_cloud(20000, 9))}) {
    const tests::CellPoints moved(cloud, {.cell = 0.5f, .width = 300});

    for (const MovedPoint& point : moved.groups.points(0, moved.cells.group_count())) {
      const Point& original = cloud[point.index];
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.x), std::bit_cast<std::uint32_t>(original.x));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.y), std::bit_cast<std::uint32_t>(original.y));
      ASSERT_EQ(std::bit_cast<std::uint32_t>(point.z), std::bit_cast<std::uint32_t>(original.z));
    }
  }
}

TEST_P(MovedPointsOn, DoNotDependOnThePreviousScan) {
  const std::vector<Point> first = shuffled(tests::corrupted_cloud(20000, 2));
  tests::CellPoints moved(first, {.cell = 1, .width = 150});
  // Fewer bins, then more than any previous scan, then fewer again.
  for (const tests::SquareCells& cells :
       {tests::SquareCells{.cell = 2, .width = 40}, tests::SquareCells{.cell = 0.5f, .width = 400},
        tests::SquareCells{.cell = 5, .width = 10}}) {
    const std::vector<Point> cloud = tests::random_cloud(9000, cells.width);
    moved.cells = cells;

    moved.group(cloud);

    const NaiveOrder expected(cloud, cells);
    EXPECT_EQ(indices_of(moved.groups.points(0, cells.group_count())), expected.indices);
    for (std::uint32_t bin = 0; bin < cells.group_count(); ++bin) {
      ASSERT_EQ(indices_of(moved.groups.points(bin)), expected.range(bin, bin + 1));
    }
  }
}

TEST_P(MovedPointsOn, AreCorrectIfRunsAreJustLongEnoughToSort) {
  for (const std::size_t run_length : {1U, 2U, 3U, 8U, 9U, 16U, 17U}) {
    const std::vector<Point> cloud = by_turns(20000, run_length);
    const tests::SquareCells cells{.cell = 1, .width = 20};

    const tests::CellPoints moved(cloud, cells);

    EXPECT_EQ(indices_of(moved.groups.points(0, cells.group_count())),
              NaiveOrder(cloud, cells).indices)
        << run_length;
  }
}

}  // namespace
}  // namespace flagstone::plane_fits
