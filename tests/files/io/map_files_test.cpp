// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/io/map_files.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"
#include "library/ground_map/ground_scan.hpp"

namespace flagstone::io {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

double slope(double x, double /*y*/) { return 0.02 * x; }

void add_scan(GroundMap& map, double x) {
  const Pose pose = upright_pose(slope, x, 0);
  const GroundScan scan(slope, pose, 20);
  Levelling levelling;
  EXPECT_THAT(map.add(scan.view(), scan.result, pose, levelling), is_ok());
}

void add_scan(LabelVote& vote, double x) {
  const Pose pose = upright_pose(slope, x, 0);
  const GroundScan scan(slope, pose, 20);
  EXPECT_THAT(vote.add(scan.view(), scan.result, pose, {}), is_ok());
}

void add_scan(MovingPoints& moving, double x) {
  const Pose pose = upright_pose(slope, x, 0);
  const GroundScan scan(slope, pose, 20);
  MovingMask mask;
  EXPECT_THAT(moving.add(scan.view(), scan.result, pose, {}, x, mask), is_ok());
}

template <class State>
std::vector<std::byte> bytes_of(const State& state) {
  std::vector<std::byte> bytes;
  EXPECT_THAT(state.to_bytes(bytes), is_ok());
  return bytes;
}

template <class State>
class MapFile : public testing::Test {};
using States = testing::Types<GroundMap, LabelVote, MovingPoints>;
TYPED_TEST_SUITE(MapFile, States);

TYPED_TEST(MapFile, IsLoadedAsItWasSaved) {
  const TemporaryFolder folder;
  TypeParam saved;
  add_scan(saved, 0);
  TypeParam loaded;

  EXPECT_THAT(save(folder / "state", saved), is_ok());
  EXPECT_THAT(load(folder / "state", loaded), is_ok());

  EXPECT_EQ(bytes_of(loaded), bytes_of(saved));
  EXPECT_EQ(folder.entries(), 1);
}

TYPED_TEST(MapFile, IsRejectedWithItsPathIfDamaged) {
  const TemporaryFolder folder;
  put_file(folder / "state", "something else");
  TypeParam state;
  add_scan(state, 0);
  const std::vector<std::byte> before = bytes_of(state);

  const Status status = load(folder / "state", state);

  EXPECT_EQ(status.code(), StatusCode::bad_file);
  EXPECT_THAT(status.message(),
              StartsWith((folder / "state").string() + ": byte 0: not the state"));
  EXPECT_EQ(bytes_of(state), before);
}

TYPED_TEST(MapFile, ThatIsMissingIsReported) {
  const TemporaryFolder folder;
  TypeParam state;
  EXPECT_EQ(load(folder / "state", state).code(), StatusCode::not_found);
}

TEST(TileFiles, ContainTheTilesBeyondTheMemoryLimit) {
  const TemporaryFolder folder;
  GroundMap everything;
  GroundMap limited({.max_memory = 1 << 20}, std::make_shared<TileFiles>(folder / ""));
  for (double x = 0; x < 400; x += 20) {
    add_scan(everything, x);
    add_scan(limited, x);
  }

  EXPECT_GT(folder.entries(), 10);
  EXPECT_LT(limited.bytes(), everything.bytes() / 2);
  EXPECT_EQ(bytes_of(limited), bytes_of(everything));
}

TEST(TileFiles, ThatCannotBeWrittenAreReportedWithTheirPath) {
  const TemporaryFolder folder;
  GroundMap map({.max_memory = 1}, std::make_shared<TileFiles>(folder / "missing"));
  const Pose pose = upright_pose(slope, 0, 0);
  const GroundScan scan(slope, pose, 20);
  Levelling levelling;

  const Status status = map.add(scan.view(), scan.result, pose, levelling);

  EXPECT_EQ(status.code(), StatusCode::unwritable);
  EXPECT_THAT(status.message(), HasSubstr("missing"));
}

TEST(TileFiles, ThatAreMissingAreReportedAndTheMapStaysAsItWas) {
  const TemporaryFolder folder;
  GroundMap map({.max_memory = 1}, std::make_shared<TileFiles>(folder / ""));
  add_scan(map, 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "")) {
    std::filesystem::remove(entry.path());
  }
  const Pose pose = upright_pose(slope, 1, 0);
  const GroundScan scan(slope, pose, 20);
  Levelling levelling;

  EXPECT_EQ(map.add(scan.view(), scan.result, pose, levelling).code(), StatusCode::not_found);

  EXPECT_EQ(map.scans(), 1U);
}

}  // namespace
}  // namespace flagstone::io
