// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Counts allocations by operator new, and is therefore a separate program.
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "counted_allocation.hpp"
#include "methods.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// Tests of allocations; the parameter is the method.
class Allocation : public testing::TestWithParam<tests::Method> {};

INSTANTIATE_TEST_SUITE_P(All, Allocation, testing::ValuesIn(tests::methods()), tests::name_of);

TEST_P(Allocation, SegmentAllocatesNothingAfterWarmUp) {
  const std::vector<Point> large = tests::random_cloud(60000, 1);
  const std::vector<Point> other = tests::corrupted_cloud(60000, 2);
  const std::vector<Point> small = tests::random_cloud(500, 3);
  const auto segmenter = GetParam().make();
  Segmentation result;
  ASSERT_TRUE(segmenter->segment(tests::view_of(large), result).ok());

  io::allocated = 0;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const auto* cloud : {&other, &small, &large}) {
      ASSERT_TRUE(segmenter->segment(tests::view_of(*cloud), result).ok());
    }
  }

  EXPECT_EQ(io::allocated, 0u);
}

TEST_P(Allocation, TheCounterCountsAllocationsOfTheWarmUp) {
  const std::vector<Point> cloud = tests::random_cloud(1000, 1);
  io::allocated = 0;
  Segmentation result;
  ASSERT_TRUE(GetParam().make()->segment(tests::view_of(cloud), result).ok());

  EXPECT_GT(io::allocated, 0u);
}

TEST_P(Allocation, ReturnsOutOfMemoryAndSegmentsTheNextScan) {
  const std::vector<Point> small = tests::random_cloud(1000, 1);
  const std::vector<Point> large = tests::random_cloud(30000, 1);
  const auto segmenter = GetParam().make();
  Segmentation result;
  ASSERT_TRUE(segmenter->segment(tests::view_of(small), result).ok());

  io::allowed = 0;
  const Status status = segmenter->segment(tests::view_of(large), result);
  io::allowed = io::unlimited;

  EXPECT_EQ(status.code(), StatusCode::out_of_memory);
  EXPECT_TRUE(result.labels().empty());
  EXPECT_TRUE(segmenter->segment(tests::view_of(small), result).ok());
  EXPECT_EQ(result.labels().size(), small.size());
}

}  // namespace
}  // namespace flagstone
