// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Counts allocations through a replaced operator new; hence a program of its own.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

#include "flagstone/flagstone.hpp"
#include "made_up_cloud.hpp"

namespace {

std::atomic<std::size_t> allocations = 0;
std::atomic<bool> memory_is_out = false;

}  // namespace

void* operator new(std::size_t size) {
  if (memory_is_out) throw std::bad_alloc();
  ++allocations;
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace flagstone {
namespace {

TEST(Allocation, SegmentAllocatesNothingAfterWarmUp) {
  const std::vector<Point> large = tests::made_up_cloud(120000, 1);
  const std::vector<Point> other = tests::corrupted_cloud(120000, 2);
  const std::vector<Point> small = tests::made_up_cloud(500, 3);
  Patchwork patchwork;
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(tests::view_of(large), result).ok());

  const std::size_t before = allocations;
  for (int repeat = 0; repeat < 3; ++repeat) {
    for (const auto* cloud : {&other, &small, &large}) {
      ASSERT_TRUE(patchwork.segment(tests::view_of(*cloud), result).ok());
    }
  }

  EXPECT_EQ(allocations - before, 0u);
}

TEST(Allocation, WarmUpAllocatesSoThatTheCounterIsSeenToCount) {
  const std::vector<Point> cloud = tests::made_up_cloud(1000, 1);
  const std::size_t before = allocations;
  Patchwork patchwork;
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(tests::view_of(cloud), result).ok());

  EXPECT_GT(allocations - before, 0u);
}

TEST(Allocation, WithoutMemoryAScanIsRefusedAndTheNextOneSegmented) {
  const std::vector<Point> cloud = tests::made_up_cloud(1000, 1);
  Patchwork patchwork;
  Segmentation result;

  memory_is_out = true;
  const Status status = patchwork.segment(tests::view_of(cloud), result);
  memory_is_out = false;

  EXPECT_EQ(status.code(), StatusCode::out_of_memory);
  EXPECT_TRUE(result.labels().empty());
  EXPECT_TRUE(patchwork.segment(tests::view_of(cloud), result).ok());
  EXPECT_EQ(result.labels().size(), cloud.size());
}

}  // namespace
}  // namespace flagstone
