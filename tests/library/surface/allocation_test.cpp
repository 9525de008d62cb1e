// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Counts what operator new hands out; hence a program of its own. What is said of every method
// stands in tests/lab/baselines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "counted_allocation.hpp"
#include "flagstone/surface.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::view_of;

std::vector<Point> shuffled(std::vector<Point> cloud) {
  std::ranges::shuffle(cloud, std::mt19937(1));
  return cloud;
}

/// The parameter is the number of threads.
class SurfaceAllocation : public testing::TestWithParam<unsigned> {
 protected:
  void warm_up(const std::vector<Point>& cloud) {
    ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());
    io::allocated = 0;
  }

  Surface segmenter{{}, GetParam()};
  Segmentation result;
};

INSTANTIATE_TEST_SUITE_P(Threads, SurfaceAllocation, testing::Values(1U, 2U, 5U),
                         testing::PrintToStringParamName());

TEST_P(SurfaceAllocation, TheFirstScanAllocates) {
  const std::vector<Point> cloud = tests::random_cloud(1000, 1);
  io::allocated = 0;

  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  EXPECT_GT(io::allocated, 0U);
}

TEST_P(SurfaceAllocation, OneScanIsEnoughForAllOfItsSizeInAnyOrderAndSmallerOnes) {
  // In order runs are sorted, in no order points: room for both is made at once.
  const std::vector<Point> in_order = tests::random_cloud(60000, 1);
  const std::vector<Point> in_no_order = shuffled(in_order);
  const std::vector<Point> corrupted = tests::corrupted_cloud(60000, 2);
  const std::vector<Point> in_one_place(60000, Point{6.1f, 2.3f, -1.7f});
  const std::vector<Point> small = tests::random_cloud(500, 3);
  const std::vector<Point> none;
  warm_up(in_order);

  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const auto* cloud : {&in_no_order, &corrupted, &small, &none, &in_one_place, &in_order}) {
      ASSERT_TRUE(segmenter.segment(view_of(*cloud), result).ok());
    }
  }

  EXPECT_EQ(io::allocated, 0U);
}

TEST_P(SurfaceAllocation, AScanInOneCellIsEnoughForAllOfItsSize) {
  warm_up(std::vector<Point>(60000, Point{6.1f, 2.3f, -1.7f}));
  const std::vector<Point> in_no_order = shuffled(tests::random_cloud(60000, 1));
  io::allocated = 0;

  ASSERT_TRUE(segmenter.segment(view_of(in_no_order), result).ok());

  EXPECT_EQ(io::allocated, 0U);
}

TEST_P(SurfaceAllocation, OnlyGrowingScansAllocate) {
  warm_up(tests::random_cloud(100, 1));
  for (const std::size_t size : {9000U, 20000U, 40000U}) {
    const std::vector<Point> larger = tests::random_cloud(size, 2);
    const std::vector<Point> smaller = tests::random_cloud(size / 2, 3);
    io::allocated = 0;
    ASSERT_TRUE(segmenter.segment(view_of(larger), result).ok());
    EXPECT_GT(io::allocated, 0U) << size;
    io::allocated = 0;

    ASSERT_TRUE(segmenter.segment(view_of(smaller), result).ok());
    ASSERT_TRUE(segmenter.segment(view_of(larger), result).ok());

    EXPECT_EQ(io::allocated, 0U) << size;
  }
}

TEST(SurfaceMemory, WhereverItEndsAScanIsRefusedAndTheNextOneSegmented) {
  const std::vector<Point> cloud = tests::random_cloud(9000, 1);
  Segmentation fresh;
  ASSERT_TRUE(Surface().segment(view_of(cloud), fresh).ok());
  std::size_t refused = 0;
  for (std::size_t allowed = 0;; allowed += 20000) {
    Surface segmenter;
    Segmentation result;
    io::allocated = 0;
    io::allowed = allowed;
    const Status status = segmenter.segment(view_of(cloud), result);
    io::allowed = io::unlimited;

    if (status.ok()) break;
    ++refused;
    EXPECT_EQ(status.code(), StatusCode::out_of_memory);
    EXPECT_TRUE(result.labels().empty());
    EXPECT_TRUE(result.patches().empty());
    EXPECT_TRUE(result.heights().empty());
    EXPECT_TRUE(result.surface().empty());
    ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());
    EXPECT_TRUE(std::ranges::equal(result.labels(), fresh.labels())) << allowed;
  }
  EXPECT_GT(refused, 5U);
}

TEST(SurfaceMemory, OfOneThreadIsAtMost64BytesAPoint) {
  constexpr std::size_t points = 1'000'000;
  const std::vector<Point> cloud = shuffled(tests::random_cloud(points, 1));
  io::allocated = 0;

  Surface segmenter;
  Segmentation result;
  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  const std::size_t held = io::allocated;  // nothing of it is given back
  RecordProperty("bytes_a_point", static_cast<int>(held / points));
  EXPECT_LE(held, 64 * points);
  EXPECT_GE(held, 12 * points) << "the coordinates at least are counted";
}

}  // namespace
}  // namespace flagstone
