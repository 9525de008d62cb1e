// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Counts what every form of operator new hands out; hence a program of its own. What is said of
// every method stands in tests/lab/baselines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "flagstone/patchwork.hpp"
#include "lab/bench/allocation_count.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using bench::allocation_count;
using tests::view_of;

std::vector<Point> shuffled(std::vector<Point> cloud) {
  std::ranges::shuffle(cloud, std::mt19937(1));
  return cloud;
}

/// The parameter is the number of threads.
class PatchworkAllocation : public testing::TestWithParam<unsigned> {
 protected:
  Patchwork patchwork{{}, GetParam()};
  Segmentation result;
};

INSTANTIATE_TEST_SUITE_P(Threads, PatchworkAllocation, testing::Values(1U, 2U, 5U),
                         testing::PrintToStringParamName());

TEST_P(PatchworkAllocation, TheFirstScanAllocates) {
  const std::vector<Point> cloud = tests::random_cloud(1000, 1);
  const std::size_t before = allocation_count().calls;

  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  EXPECT_GT(allocation_count().calls, before);
}

TEST_P(PatchworkAllocation, OneScanIsEnoughForAllOfItsSizeInAnyOrderAndSmallerOnes) {
  // In order runs are sorted, in no order points: room for both is made at once.
  const std::vector<Point> in_order = tests::random_cloud(60000, 1);
  const std::vector<Point> in_no_order = shuffled(in_order);
  const std::vector<Point> corrupted = tests::corrupted_cloud(60000, 2);
  const std::vector<Point> in_one_place(60000, Point{6.1f, 2.3f, -1.7f});
  const std::vector<Point> small = tests::random_cloud(500, 3);
  ASSERT_TRUE(patchwork.segment(view_of(in_order), result).ok());
  const std::size_t before = allocation_count().calls;

  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const auto* cloud : {&in_no_order, &corrupted, &small, &in_one_place, &in_order}) {
      ASSERT_TRUE(patchwork.segment(view_of(*cloud), result).ok());
    }
  }

  EXPECT_EQ(allocation_count().calls, before);
}

TEST_P(PatchworkAllocation, AScanInOneBinIsEnoughForAllOfItsSize) {
  const std::vector<Point> in_one_place(60000, Point{6.1f, 2.3f, -1.7f});
  const std::vector<Point> in_no_order = shuffled(tests::random_cloud(60000, 1));
  ASSERT_TRUE(patchwork.segment(view_of(in_one_place), result).ok());
  const std::size_t before = allocation_count().calls;

  ASSERT_TRUE(patchwork.segment(view_of(in_no_order), result).ok());

  EXPECT_EQ(allocation_count().calls, before);
}

TEST(PatchworkMemory, OfOneThreadIsAtMost64BytesAPoint) {
  constexpr std::size_t points = 1'000'000;
  const std::vector<Point> cloud = shuffled(tests::random_cloud(points, 1));
  const std::size_t before = allocation_count().bytes;

  Patchwork patchwork;
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  const std::size_t held = allocation_count().bytes - before;
  RecordProperty("bytes_a_point", static_cast<int>(held / points));
  EXPECT_LE(held, 64 * points);
  EXPECT_GE(held, 12 * points) << "the coordinates at least are counted";
}

TEST(PatchworkMemory, IsGivenBackInTheEnd) {
  const std::vector<Point> cloud = tests::random_cloud(20000, 1);
  const std::size_t before = allocation_count().bytes;
  {
    Patchwork patchwork({}, 3);
    Segmentation result;
    ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());
  }

  EXPECT_EQ(allocation_count().bytes, before);
}

}  // namespace
}  // namespace flagstone
