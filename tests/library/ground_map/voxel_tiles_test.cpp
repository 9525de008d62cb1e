// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/voxel_tiles.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>

#include "library/core/random.hpp"

namespace flagstone {
namespace {

TEST(VoxelKey, HasTheColumnAndTheRowOfTheVoxel) {
  const std::uint32_t key = VoxelKey::of(127, 5, 70'000);

  EXPECT_EQ(VoxelKey::x(key), 127U);
  EXPECT_EQ(VoxelKey::y(key), 5U);
  EXPECT_NE(key, VoxelKey::of(127, 5, 70'001));
}

TEST(VoxelKey, RepeatsItselfAfter2To17Levels) {
  EXPECT_EQ(VoxelKey::of(1, 2, 3), VoxelKey::of(1, 2, 3 + (1U << 17U)));
}

TEST(VoxelTile, HasTheSumsOfAllVotes) {
  Random random(1);
  VoxelTile tile;
  std::map<std::uint32_t, std::int32_t> expected;
  EXPECT_EQ(tile.sum(7), 0);
  for (int i = 0; i < 20'000; ++i) {
    const auto key = static_cast<std::uint32_t>((random.bits() % 5000) << (random.bits() % 18));
    const auto vote = static_cast<std::int32_t>(random.bits() % 100) - 50;
    const std::int32_t sum = tile.add(key, vote);
    expected[key] += vote;
    ASSERT_EQ(sum, expected[key]);
  }

  EXPECT_EQ(tile.size(), expected.size());
  for (const auto& [key, sum] : expected) ASSERT_EQ(tile.sum(key), sum);
  std::map<std::uint32_t, std::int32_t> listed;
  std::uint32_t last = 0;
  for (const VoxelTile::Entry& entry : tile.sorted()) {
    EXPECT_GE(entry.key, last);
    last = entry.key;
    listed[entry.key] = entry.sum;
  }
  EXPECT_EQ(listed, expected);
}

TEST(VoxelTile, HasAtMost32BytesPerVoxelIfItIsNotSmall) {
  VoxelTile tile;
  for (std::uint32_t key = 0; key < 3000; ++key) {
    tile.add(key, 1);
    if (tile.size() > 48) {
      ASSERT_LE(tile.bytes(), 32 * tile.size());
    }
  }
}

TEST(VoxelTile, SumsDoNotOverflow) {
  VoxelTile tile;
  for (int i = 0; i < 5; ++i) EXPECT_GT(tile.add(1, 1 << 30), 0);
  for (int i = 0; i < 5; ++i) tile.add(1, -(1 << 30));

  EXPECT_LT(tile.sum(1), 0);
}

}  // namespace
}  // namespace flagstone
