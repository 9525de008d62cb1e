// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "flagstone/label_vote.hpp"
#include "library/core/random.hpp"
#include "library/ground_map/ground_scan.hpp"
#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/state_checks.hpp"

namespace flagstone {
namespace {

double waves(double x, double y) { return 0.4 * std::sin(0.11 * x) + 0.02 * y; }

// Contradicts `waves` in places.
double waves_with_roofs(double x, double y) {
  return std::fmod(std::abs(x), 9) < 2 && std::fmod(std::abs(y), 7) < 2 ? 1.4 : waves(x, y);
}

/// A run of 300 m: after every second scan comes one that contradicts it in places.
struct Run {
  Run() {
    for (int i = 0; i < 16; ++i) {
      poses.push_back(upright_pose(waves, 20.0 * i, -3.0 * i, 0.1 * i));
      scans.emplace_back(i % 2 == 0 ? waves : waves_with_roofs, poses.back(), 30);
    }
  }
  void add(GroundMap& map, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      Levelling levelling;
      EXPECT_TRUE(map.add(scans[i].view(), scans[i].result, poses[i], levelling).ok());
    }
  }
  void add(LabelVote& vote, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      EXPECT_TRUE(vote.add(scans[i].view(), scans[i].result, poses[i], {}).ok());
    }
  }

  std::vector<Pose> poses;
  std::vector<GroundScan> scans;
};

const Run& run() {
  static const Run run;
  return run;
}

template <class State>
class MapState : public testing::Test {};
using States = testing::Types<GroundMap, LabelVote>;
TYPED_TEST_SUITE(MapState, States);

TYPED_TEST(MapState, IsTheSameAfterARoundTrip) {
  TypeParam state;
  for (const std::size_t end : {0U, 1U, 5U}) {
    run().add(state, end == 5 ? 1 : 0, end);
    const Bytes bytes = bytes_of(state);
    TypeParam copy;

    ASSERT_TRUE(copy.from_bytes(bytes).ok());

    EXPECT_EQ(bytes_of(copy), bytes);
  }
}

TYPED_TEST(MapState, ScansAddedAfterLoadingGiveTheStateWithoutABreak) {
  TypeParam whole;
  run().add(whole, 0, 16);
  TypeParam first;
  run().add(first, 0, 7);
  TypeParam second;
  ASSERT_TRUE(second.from_bytes(bytes_of(first)).ok());

  run().add(second, 7, 16);

  EXPECT_EQ(bytes_of(second), bytes_of(whole));
}

TYPED_TEST(MapState, IsRejectedIfTruncatedOrDamagedAnywhere) {
  TypeParam state;
  run().add(state, 0, 2);
  TypeParam loaded;
  run().add(loaded, 2, 3);
  expect_damage_is_rejected(bytes_of(state), loaded);
}

TYPED_TEST(MapState, WithAnyNumberChangedIsRejectedOrLoadedAsItIs) {
  TypeParam state;
  run().add(state, 0, 2);
  expect_changes_are_rejected_or_kept<TypeParam>(bytes_of(state), 600, [](TypeParam&) {});
}

TYPED_TEST(MapState, ReportsAnotherVersionOrKind) {
  TypeParam state;
  Bytes bytes = bytes_of(state);
  bytes[7] = std::byte{'9'};
  EXPECT_THAT(state.from_bytes(sealed(bytes)).message(), testing::HasSubstr("another version"));
  bytes[3] = std::byte{'x'};
  EXPECT_THAT(state.from_bytes(sealed(bytes)).message(), testing::HasSubstr("byte 0: not the"));
}

TEST(GroundMapState, IsRejectedByAMapWithOtherCells) {
  GroundMap coarse({.cell = 1});
  EXPECT_THAT(coarse.from_bytes(bytes_of(GroundMap())).message(),
              testing::HasSubstr("the size of the cells differs"));
}

TEST(LabelVoteState, IsRejectedByAVoteWithOtherVoxels) {
  LabelVote coarse({.voxel_height = 0.1});
  EXPECT_THAT(coarse.from_bytes(bytes_of(LabelVote())).message(),
              testing::HasSubstr("the size of the voxels differs"));
}

/// Tiles in memory, as a stand-in for files.
class StoreInMemory : public TileStore {
 public:
  Status put(TileIndex index, std::span<const std::byte> bytes) override {
    if (put_fails) return Status(StatusCode::unwritable, "disk is full");
    ++puts;
    tiles[{index.x, index.y}].assign(bytes.begin(), bytes.end());
    return {};
  }
  Status get(TileIndex index, Bytes& bytes) const override {
    if (get_fails) return Status(StatusCode::unreadable, "disk is broken");
    bytes = tiles.at({index.x, index.y});
    return {};
  }

  std::map<std::pair<std::int64_t, std::int64_t>, Bytes> tiles;
  int puts = 0;
  bool put_fails = false;
  bool get_fails = false;
};

constexpr std::size_t one_megabyte = 1 << 20;

// There and back, so that tiles return from the store.
void add_there_and_back(GroundMap& map) {
  run().add(map, 0, 16);
  for (std::size_t i = 16; i-- > 0;) run().add(map, i, i + 1);
}

TEST(TileStore, AMapWithAMemoryLimitIsTheSameAsWithout) {
  GroundMap everything;
  const auto store = std::make_shared<StoreInMemory>();
  GroundMap limited({.max_memory = one_megabyte}, store);

  add_there_and_back(everything);
  add_there_and_back(limited);

  EXPECT_GT(store->puts, 30);
  EXPECT_LT(limited.bytes(), one_megabyte + one_megabyte / 4);
  EXPECT_GT(everything.bytes(), 3 * one_megabyte);
  EXPECT_EQ(bytes_of(limited), bytes_of(everything));
  EXPECT_EQ(limited.tiles(), everything.tiles());
  EXPECT_EQ(limited.cells(), everything.cells());
  MapTile one;
  MapTile other;
  for (const TileIndex index : everything.tiles()) {
    ASSERT_TRUE(everything.read_tile(index, one));
    ASSERT_TRUE(limited.read_tile(index, other));
    ASSERT_EQ(std::memcmp(&one, &other, sizeof one), 0);
  }
  for (double x = -30; x < 330; x += 3.7) {
    ASSERT_THAT(limited.height(x, -0.15 * x),
                testing::NanSensitiveDoubleEq(everything.height(x, -0.15 * x)));
    ASSERT_EQ(limited.at(x, -0.15 * x).scans, everything.at(x, -0.15 * x).scans);
  }
}

TEST(TileStore, AMapWithALimitCanLoadAStateThatIsLarger) {
  GroundMap everything;
  run().add(everything, 0, 16);
  const auto store = std::make_shared<StoreInMemory>();
  GroundMap limited({.max_memory = one_megabyte}, store);

  ASSERT_TRUE(limited.from_bytes(bytes_of(everything)).ok());

  EXPECT_LT(limited.bytes(), one_megabyte + one_megabyte / 4);
  EXPECT_EQ(bytes_of(limited), bytes_of(everything));
}

TEST(TileStore, AFailureToReadIsReportedAndTheMapIsAsBefore) {
  const auto store = std::make_shared<StoreInMemory>();
  GroundMap map({.max_memory = one_megabyte}, store);
  run().add(map, 0, 16);
  const Bytes before = bytes_of(map);
  store->get_fails = true;
  Levelling levelling;

  const Status status =
      map.add(run().scans[0].view(), run().scans[0].result, run().poses[0], levelling);

  EXPECT_EQ(status.message(), "disk is broken");
  EXPECT_TRUE(std::isnan(map.height(0, 0)));
  Bytes bytes;
  EXPECT_EQ(map.to_bytes(bytes).code(), StatusCode::unreadable);
  store->get_fails = false;
  EXPECT_EQ(bytes_of(map), before);
}

TEST(TileStore, DamagedTilesAreReported) {
  const auto store = std::make_shared<StoreInMemory>();
  GroundMap map({.max_memory = one_megabyte}, store);
  run().add(map, 0, 16);
  for (auto& [index, bytes] : store->tiles) bytes.pop_back();
  Levelling levelling;

  const Status status =
      map.add(run().scans[0].view(), run().scans[0].result, run().poses[0], levelling);

  EXPECT_EQ(status.code(), StatusCode::bad_file);
}

TEST(TileStore, AFailureToWriteIsReportedAndNothingIsLost) {
  GroundMap everything;
  const auto store = std::make_shared<StoreInMemory>();
  GroundMap map({.max_memory = one_megabyte}, store);
  store->put_fails = true;
  Status last;
  for (std::size_t i = 0; i < 16; ++i) {
    Levelling levelling;
    last = map.add(run().scans[i].view(), run().scans[i].result, run().poses[i], levelling);
  }
  run().add(everything, 0, 16);

  EXPECT_EQ(last.message(), "disk is full");
  EXPECT_EQ(bytes_of(map), bytes_of(everything));
}

TEST(TileStore, AndALimitNeedEachOther) {
  EXPECT_THROW(GroundMap({.max_memory = 1}), std::invalid_argument);
  EXPECT_THROW(GroundMap({}, std::make_shared<StoreInMemory>()), std::invalid_argument);
  EXPECT_THROW(GroundMap({.window = 100, .max_memory = 1}, std::make_shared<StoreInMemory>()),
               std::invalid_argument);
}

}  // namespace
}  // namespace flagstone
