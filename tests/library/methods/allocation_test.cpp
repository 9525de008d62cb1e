// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Counts the memory that operator new allocates, in a separate program. The tests for all methods
// are in tests/lab/baselines.
#include <algorithm>
#include <cstddef>

#include "counted_allocation.hpp"
#include "library/methods/methods.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::random_cloud;
using tests::shuffled;
using tests::view_of;

constexpr unsigned thread_counts[] = {1, 2, 5};

template <class Method>
class AllocationOf : public testing::Test {
 protected:
  /// Bytes that the scan allocates.
  std::size_t allocated_by(Method& segmenter, const std::vector<Point>& cloud) {
    io::allocated = 0;
    EXPECT_TRUE(segmenter.segment(view_of(cloud), result).ok());
    return io::allocated;
  }

  Segmentation result;
};

TYPED_TEST_SUITE(AllocationOf, tests::LibraryMethods);

TYPED_TEST(AllocationOf, TheFirstScanAllocates) {
  for (const unsigned threads : thread_counts) {
    TypeParam segmenter({}, threads);
    EXPECT_GT(this->allocated_by(segmenter, random_cloud(1000, 1)), 0U);
  }
}

TYPED_TEST(AllocationOf, OneScanAllocatesEnoughForScansUpToItsSizeInAnyOrder) {
  // Runs are sorted for ordered clouds, points for unordered ones. Memory is reserved for both.
  const std::vector<Point> in_order = random_cloud(60000, 1);
  const std::vector<Point> in_no_order = shuffled(in_order, 1);
  const std::vector<Point> corrupted = tests::corrupted_cloud(60000, 2);
  const std::vector<Point> in_one_place(60000, Point{6.1f, 2.3f, -1.7f});
  const std::vector<Point> small = random_cloud(500, 3);
  const std::vector<Point> none;
  for (const unsigned threads : thread_counts) {
    TypeParam segmenter({}, threads);
    this->allocated_by(segmenter, in_order);

    for (int repeat = 0; repeat < 3; ++repeat) {
      for (const auto* cloud :
           {&in_no_order, &corrupted, &small, &none, &in_one_place, &in_order}) {
        EXPECT_EQ(this->allocated_by(segmenter, *cloud), 0U) << threads << " threads";
      }
    }
  }
}

TYPED_TEST(AllocationOf, AScanAtOnePositionAllocatesEnoughForScansOfItsSize) {
  const std::vector<Point> in_one_place(60000, Point{6.1f, 2.3f, -1.7f});
  const std::vector<Point> in_no_order = shuffled(random_cloud(60000, 1), 1);
  for (const unsigned threads : thread_counts) {
    TypeParam segmenter({}, threads);
    this->allocated_by(segmenter, in_one_place);

    EXPECT_EQ(this->allocated_by(segmenter, in_no_order), 0U) << threads << " threads";
  }
}

TYPED_TEST(AllocationOf, OnlyGrowingScansAllocate) {
  for (const unsigned threads : thread_counts) {
    TypeParam segmenter({}, threads);
    this->allocated_by(segmenter, random_cloud(100, 1));
    for (const std::size_t size : {9000U, 20000U, 40000U}) {
      const std::vector<Point> larger = random_cloud(size, 2);

      EXPECT_GT(this->allocated_by(segmenter, larger), 0U) << size;
      EXPECT_EQ(this->allocated_by(segmenter, random_cloud(size / 2, 3)), 0U) << size;
      EXPECT_EQ(this->allocated_by(segmenter, larger), 0U) << size;
    }
  }
}

TYPED_TEST(AllocationOf, AScanFailsWhereverMemoryRunsOutAndTheNextIsSegmented) {
  const std::vector<Point> cloud = random_cloud(9000, 1);
  Segmentation fresh;
  ASSERT_TRUE(TypeParam().segment(view_of(cloud), fresh).ok());
  std::size_t refused = 0;
  for (std::size_t allowed = 0;; allowed += 20000) {
    TypeParam segmenter;
    Segmentation refusal;
    io::allocated = 0;
    io::allowed = allowed;
    const Status status = segmenter.segment(view_of(cloud), refusal);
    io::allowed = io::unlimited;

    if (status.ok()) break;
    ++refused;
    EXPECT_EQ(status.code(), StatusCode::out_of_memory);
    EXPECT_TRUE(refusal.labels().empty());
    EXPECT_TRUE(refusal.patches().empty());
    EXPECT_TRUE(refusal.heights().empty());
    EXPECT_TRUE(refusal.surface().empty());
    ASSERT_TRUE(segmenter.segment(view_of(cloud), refusal).ok());
    EXPECT_TRUE(std::ranges::equal(refusal.labels(), fresh.labels())) << allowed;
  }
  EXPECT_GT(refused, 5U);
}

TYPED_TEST(AllocationOf, OneThreadTakesAtMost64BytesPerPoint) {
  constexpr std::size_t points = 1'000'000;
  const std::vector<Point> cloud = shuffled(random_cloud(points, 1), 1);
  io::allocated = 0;
  TypeParam segmenter;
  const std::size_t before = io::allocated;

  const std::size_t held = before + this->allocated_by(segmenter, cloud);  // nothing is freed

  this->RecordProperty("bytes_per_point", static_cast<int>(held / points));
  EXPECT_LE(held, 64 * points);
  EXPECT_GE(held, 12 * points) << "at least the coordinates are counted";
}

TYPED_TEST(AllocationOf, AllMemoryIsFreedInTheEnd) {
  const std::vector<Point> cloud = random_cloud(20000, 1);
  const std::ptrdiff_t before = io::blocks;
  {
    TypeParam segmenter({}, 3);
    Segmentation freed;
    ASSERT_TRUE(segmenter.segment(view_of(cloud), freed).ok());
    EXPECT_GT(io::blocks, before);
  }

  EXPECT_EQ(io::blocks, before);
}

}  // namespace
}  // namespace flagstone
