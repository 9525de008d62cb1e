// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patches/bin_groups.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "made_up_cloud.hpp"
#include "patches/sorted_scan.hpp"

namespace flagstone::patches {
namespace {

using patchwork::ConcentricZones;
using patchwork::read_chunk;

using Lists = std::vector<std::vector<std::uint32_t>>;  ///< indices of the points of each bin

/// The points of each bin in input order, found one by one.
Lists naive(const ScanPoints& scan, std::size_t points, const ConcentricZones& zones) {
  std::vector<std::uint32_t> bins(points);
  zones.locate(scan.x(), scan.y(), scan.z(), points, bins.data());
  Lists lists(zones.group_count());
  for (std::uint32_t i = 0; i < points; ++i) lists.at(bins[i]).push_back(i);
  return lists;
}

/// The same as the groups have it.
Lists listed(const BinGroups& groups, std::uint32_t group_count) {
  Lists lists(group_count);
  for (std::uint32_t bin = 0; bin < group_count; ++bin) lists[bin] = tests::points_of(groups, bin);
  return lists;
}

std::vector<Point> shuffled(std::vector<Point> cloud) {
  std::ranges::shuffle(cloud, std::mt19937(1));
  return cloud;
}

TEST(BinGroups, HoldEveryPointOfEveryBinInInputOrder) {
  EXPECT_TRUE(rc::check([] {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 200),
                                      rc::gen::inRange<std::size_t>(8000, 20000));
    const auto seed = *rc::gen::inRange<std::uint32_t>(0, 1000);
    std::vector<Point> cloud = tests::corrupted_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = tests::made_up_cloud(size, seed);
    if (*rc::gen::arbitrary<bool>()) cloud = shuffled(std::move(cloud));

    const tests::SortedScan sorted(cloud, {});

    RC_TAG(sorted.groups.moved() ? "scattered" : "runs");
    const Lists expected = naive(sorted.scan, size, sorted.zones);
    RC_ASSERT(listed(sorted.groups, sorted.zones.group_count()) == expected);
    for (std::uint32_t bin = 0; bin < expected.size(); ++bin) {
      RC_ASSERT(sorted.groups.size(bin) == expected[bin].size());
    }
  }));
}

TEST(BinGroups, OfAScanInOrderAreRuns) {
  EXPECT_FALSE(tests::SortedScan(tests::made_up_cloud(100000, 1), {}).groups.moved());
}

TEST(BinGroups, OfACloudInNoOrderAreScattered) {
  EXPECT_TRUE(tests::SortedScan(shuffled(tests::made_up_cloud(100000, 1)), {}).groups.moved());
}

/// `run_length` points by turns in two bins opposite each other.
std::vector<Point> by_turns(std::size_t points, std::size_t run_length) {
  std::vector<Point> cloud;
  cloud.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    cloud.push_back({i / run_length % 2 == 0 ? 5.0f : -5.0f, 0.5f, -1.7f});
  }
  return cloud;
}

TEST(BinGroups, AreRightWhereRunsAreJustLongEnoughToKeep) {
  // Four points a run is what memory is reserved for; chunks of 8,192 end between runs.
  for (const std::size_t run_length : {1U, 3U, 4U, 5U}) {
    const std::vector<Point> cloud = by_turns(40000, run_length);

    const tests::SortedScan sorted(cloud, {});

    EXPECT_EQ(sorted.groups.moved(), run_length < 4) << run_length;
    EXPECT_EQ(listed(sorted.groups, sorted.zones.group_count()),
              naive(sorted.scan, cloud.size(), sorted.zones))
        << run_length;
  }
}

TEST(BinGroups, ForgetTheScanBefore) {
  const std::vector<Point> first = shuffled(tests::corrupted_cloud(20000, 2));
  const std::vector<Point> second = tests::made_up_cloud(9000, 3);
  tests::SortedScan sorted(first, {});

  for (std::size_t i = 0; i < ScanPoints::chunk_count(second.size()); ++i) {
    read_chunk(tests::view_of(second), i, sorted.zones, sorted.scan);
  }
  sorted.groups.group(sorted.scan, second.size(), sorted.zones.group_count());

  EXPECT_EQ(listed(sorted.groups, sorted.zones.group_count()),
            naive(sorted.scan, second.size(), sorted.zones));
}

}  // namespace
}  // namespace flagstone::patches
