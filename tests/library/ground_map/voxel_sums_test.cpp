// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/voxel_sums.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "library/core/random.hpp"

namespace flagstone {
namespace {

TEST(VoxelSums, EqualAMapOfTheSameSums) {
  Random random(1);
  VoxelSums<int> sums;
  std::map<std::uint64_t, int> expected;
  for (int i = 0; i < 20'000; ++i) {
    const std::uint64_t key = (random.bits() % 5000) << (random.bits() % 40);
    sums.at(key) += i;
    expected[key] += i;
  }

  EXPECT_EQ(sums.size(), expected.size());
  for (const auto& [key, sum] : expected) {
    ASSERT_NE(sums.find(key), nullptr);
    EXPECT_EQ(*sums.find(key), sum);
  }
  std::map<std::uint64_t, int> listed;
  sums.for_each([&](std::uint64_t key, int sum) { listed[key] = sum; });
  EXPECT_EQ(listed, expected);
}

TEST(VoxelSums, HaveNoVoxelsAfterClear) {
  VoxelSums<int> sums;
  EXPECT_EQ(sums.find(7), nullptr);
  sums.at(7) = 3;

  sums.clear();

  EXPECT_EQ(sums.find(7), nullptr);
  EXPECT_EQ(sums.size(), 0U);
  EXPECT_EQ(sums.at(7), 0);
}

}  // namespace
}  // namespace flagstone
