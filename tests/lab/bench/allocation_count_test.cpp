// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/allocation_count.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <vector>

#include "lab/bench/candidates.hpp"
#include "library/core/simd_target.hpp"
#include "random_cloud.hpp"

namespace flagstone::bench {
namespace {

TEST(AllocationCount, IsDetectedInThisProgram) { EXPECT_TRUE(allocations_are_counted()); }

TEST(AllocationCount, CountsEveryFormOfNewAndReleasesBytesOnDelete) {
  // Called by name, because compilers may remove pairs of new and delete expressions.
  constexpr std::align_val_t alignment{256};
  const AllocationCount before = allocation_count();
  void* const one = ::operator new(4);
  void* const many = ::operator new[](1000);
  void* const aligned = ::operator new(300, alignment);
  void* const without_exceptions = ::operator new(8, std::nothrow);
  const AllocationCount held = allocation_count();
  ::operator delete(one);
  ::operator delete[](many);
  ::operator delete(aligned, alignment);
  ::operator delete(without_exceptions);
  const AllocationCount after = allocation_count();

  EXPECT_EQ(held.calls - before.calls, 4U);
  EXPECT_GE(held.bytes - before.bytes, 4U + 1000 + 300 + 8);
  EXPECT_EQ(after.calls, held.calls);
  EXPECT_EQ(after.bytes, before.bytes);
}

TEST(AllocationCount, AlignedMemoryIsAligned) {
  constexpr std::align_val_t alignment{256};
  void* const aligned = ::operator new(1, alignment);

  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(aligned) % 256, 0U);
  ::operator delete(aligned, alignment);
}

TEST(AllocationCount, TheFirstScanAllocatesAndTheSecondDoesNot) {
  const std::vector<Point> cloud = tests::random_cloud(5000, 1);
  const std::vector<CloudView> views = {tests::view_of(cloud)};
  for (const TimedConfig& config : {TimedConfig(PatchworkConfig{}), TimedConfig(SurfaceConfig{})}) {
    TimedSegment segment(views, config, MountSettings{}, 1, simd_target());

    segment.run_trial(0);
    const std::size_t first = segment.allocations();
    segment.run_trial(0);
    use_simd_target("");

    EXPECT_GT(first, 0U) << method_name(config);
    EXPECT_EQ(segment.allocations(), 0U) << method_name(config);
  }
}

}  // namespace
}  // namespace flagstone::bench
