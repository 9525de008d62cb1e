// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/buffer.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <utility>

namespace flagstone {
namespace {

template <class T>
bool begins_at_a_cache_line(const Buffer<T>& buffer) {
  return reinterpret_cast<std::uintptr_t>(buffer.data()) % 64 == 0;
}

TEST(Buffer, IsEmptyByDefault) { EXPECT_EQ(Buffer<float>().data(), nullptr); }

TEST(Buffer, IsAlignedToACacheLineForAnySizeAndType) {
  for (const std::size_t count : {1U, 3U, 16U, 17U, 1000U, 70001U}) {
    Buffer<float> floats;
    Buffer<std::uint8_t> bytes;
    floats.reserve(count);
    bytes.reserve(count);
    EXPECT_TRUE(begins_at_a_cache_line(floats)) << count;
    EXPECT_TRUE(begins_at_a_cache_line(bytes)) << count;
  }
}

TEST(Buffer, CanBeWrittenUpToItsLastElement) {
  Buffer<std::uint32_t> buffer;
  buffer.reserve(1001);
  for (std::uint32_t i = 0; i < 1001; ++i) buffer.data()[i] = i;

  for (std::uint32_t i = 0; i < 1001; ++i) ASSERT_EQ(buffer.data()[i], i);
}

TEST(Buffer, KeepsItsAddressAndContentsUnlessItHasToGrow) {
  Buffer<int> buffer;
  buffer.reserve(100);
  const int* const place = buffer.data();
  buffer.data()[99] = 42;

  for (const std::size_t count : {100U, 1U, 0U, 99U}) buffer.reserve(count);

  EXPECT_EQ(buffer.data(), place);
  EXPECT_EQ(buffer.data()[99], 42);
}

TEST(Buffer, IsAlignedAfterItGrows) {
  Buffer<double> buffer;
  for (std::size_t count = 1; count < 5000; count = count * 2 + 1) {
    buffer.reserve(count);
    buffer.data()[count - 1] = 1;
    EXPECT_TRUE(begins_at_a_cache_line(buffer));
  }
}

TEST(Buffer, MovesItsContentsAndLeavesTheSourceEmpty) {
  Buffer<int> from;
  from.reserve(10);
  from.data()[9] = 7;
  const int* const place = from.data();

  Buffer<int> to = std::move(from);

  EXPECT_EQ(to.data(), place);
  EXPECT_EQ(to.data()[9], 7);
  EXPECT_EQ(from.data(), nullptr);  // NOLINT(bugprone-use-after-move): this is tested
  from.reserve(5);
  EXPECT_NE(from.data(), nullptr);
}

TEST(Buffer, MoveAssignmentTransfersTheContents) {
  Buffer<int> from;
  from.reserve(10);
  from.data()[9] = 7;
  Buffer<int> to;
  to.reserve(3);

  to = std::move(from);
  to.reserve(10);  // already has this capacity

  EXPECT_EQ(to.data()[9], 7);
}

// Sanitizers abort instead of throwing. GCC reports them with a macro, clang with __has_feature.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MEMORY_IS_WATCHED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define MEMORY_IS_WATCHED
#endif
#endif

#ifndef MEMORY_IS_WATCHED
TEST(Buffer, IsEmptyAndUsableAfterAFailedAllocation) {
  Buffer<double> buffer;
  buffer.reserve(10);

  EXPECT_THROW(buffer.reserve(std::size_t{1} << 55U), std::bad_alloc);

  EXPECT_EQ(buffer.data(), nullptr);
  buffer.reserve(10);
  buffer.data()[9] = 1;
  EXPECT_EQ(buffer.data()[9], 1);
}
#endif

}  // namespace
}  // namespace flagstone
