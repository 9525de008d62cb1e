// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/ground_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "library/ground_map/ground_scan.hpp"

namespace flagstone {
namespace {

double hills(double x, double y) {
  return 0.03 * x + std::sin(0.05 * x) + 0.5 * std::cos(0.07 * y);
}

Levelling add(GroundMap& map, const GroundScan& scan, const Pose& pose) {
  Levelling levelling;
  EXPECT_TRUE(map.add(scan.view(), scan.result, pose, levelling).ok());
  return levelling;
}

// A pose with an error in height and pitch.
Pose wrong(Pose pose, double up, double pitch) {
  const double c = std::cos(pitch);
  const double s = std::sin(pitch);
  auto& r = pose.rotation;
  for (std::size_t row = 0; row < 9; row += 3) {  // turned about the y axis of the sensor
    const double x = r[row];
    const double z = r[row + 2];
    r[row] = c * x - s * z;
    r[row + 2] = s * x + c * z;
  }
  pose.position[2] += up;
  return pose;
}

// The largest error of the map within 20 m of (x, y), metres.
double worst_error(const GroundMap& map, const TrueGround& ground, double x, double y) {
  double worst = 0;
  for (double dy = -20; dy <= 20; dy += 1.3) {
    for (double dx = -20; dx <= 20; dx += 1.3) {
      worst = std::max(worst, std::abs(map.height(x + dx, y + dy) - ground(x + dx, y + dy)));
    }
  }
  return worst;
}

TEST(GroundMap, IsEmptyAtFirst) {
  const GroundMap map;

  EXPECT_TRUE(std::isnan(map.height(0, 0)));
  EXPECT_TRUE(std::isnan(map.at(0, 0).height));
  EXPECT_EQ(map.at(0, 0).scans, 0U);
  EXPECT_EQ(map.cells(), 0U);
}

TEST(GroundMap, HasTheHeightsThatTheScansMeasured) {
  GroundMap map;
  for (double x = 0; x < 60; x += 5) {
    const Pose pose = upright_pose(hills, x, 0.1 * x, 0.02 * x);
    add(map, GroundScan(hills, pose), pose);
  }

  for (double x = 0; x < 60; x += 10) EXPECT_LT(worst_error(map, hills, x, 0.1 * x), 0.01);
  const MapSample sample = map.at(20.3, 4.1);
  EXPECT_NEAR(sample.height, hills(20.3, 4.1), 0.01);
  EXPECT_NEAR(
      sample.slope,
      std::atan(std::hypot(0.03 + 0.05 * std::cos(0.05 * 20.3), -0.035 * std::sin(0.07 * 4.1))),
      0.01);
  EXPECT_GT(sample.scans, 5U);
  EXPECT_EQ(sample.contradictions, 0U);
}

TEST(GroundMap, CoordinatesMayBeLarge) {
  const auto ground = [](double x, double) { return 2000 + 0.02 * (x - 500'000); };
  GroundMap map;
  const Pose pose = upright_pose(ground, 500'000, 5'400'000);
  add(map, GroundScan(ground, pose), pose);

  EXPECT_LT(worst_error(map, ground, 500'000, 5'400'000), 0.01);
}

TEST(GroundMap, LevellingRemovesErrorsInHeightAndPitch) {
  GroundMap map;
  const Pose first = upright_pose(hills, 0, 0);
  add(map, GroundScan(hills, first), first);
  const Pose second = upright_pose(hills, 4, 0);
  constexpr double up = 0.3;
  constexpr double pitch = 0.01;

  const Levelling levelling = add(map, GroundScan(hills, second), wrong(second, up, pitch));

  EXPECT_TRUE(levelling.applied);
  EXPECT_GT(levelling.cells, 5000U);
  EXPECT_NEAR(levelling.at(4, 0, {4, 0, 0}), up, 0.03);
  EXPECT_NEAR(std::abs(levelling.slope_x), pitch, 0.001);
  EXPECT_LT(worst_error(map, hills, 2, 0), 0.03);
}

// Adds scans along 20 m of x and back, with poses that are `up` metres too high on the way back.
// Returns the corrections on the way back.
std::vector<Levelling> run_there_and_back(GroundMap& map, double up) {
  for (double x = 0; x <= 20; x += 1) {
    const Pose pose = upright_pose(hills, x, 0);
    add(map, GroundScan(hills, pose), pose);
  }
  std::vector<Levelling> levellings;
  for (double x = 20; x >= 0; x -= 1) {
    Pose pose = upright_pose(hills, x, 2, 3.14);
    const GroundScan scan(hills, pose);
    pose.position[2] += up;
    levellings.push_back(add(map, scan, pose));
  }
  return levellings;
}

// The rule for loops: the first pass decides.
TEST(GroundMap, LaterPassesAreLevelledToTheFirst) {
  GroundMap map;

  const std::vector<Levelling> levellings = run_there_and_back(map, 0.5);

  for (const Levelling& levelling : levellings) EXPECT_NEAR(levelling.offset, 0.5, 0.01);
  EXPECT_LT(worst_error(map, hills, 10, 0), 0.02);
  EXPECT_EQ(map.at(10, 0).contradictions, 0U);
}

TEST(GroundMap, APassBeyondTheMaxCorrectionIsAddedAsItIsAndCountsAsContradictions) {
  GroundMap map({.max_correction = 1});

  const std::vector<Levelling> levellings = run_there_and_back(map, 2);

  for (const Levelling& levelling : levellings) EXPECT_FALSE(levelling.applied);
  EXPECT_GT(map.at(10, 0).contradictions, 2U);
  // The same number of scans: the first pass keeps the cells that it saw from as near.
  EXPECT_LT(std::abs(map.height(10, -3) - hills(10, -3)), 0.02);
}

// Each scan is levelled to those before it: without poses, the errors of levelling would add up.
TEST(GroundMap, FollowsThePosesOfALongRun) {
  Random random(7);
  GroundMap map({.window = 60});
  for (double x = 0; x <= 600; x += 2) {
    const Pose pose = upright_pose(hills, x, 0);
    const GroundScan scan(hills, pose);
    const Levelling levelling =
        add(map, scan, wrong(pose, 0.02 * random.normal(), 0.003 * random.normal()));
    if (x == 0) continue;
    EXPECT_TRUE(levelling.applied) << x;
  }
  EXPECT_LT(std::abs(map.height(600, 0) - hills(600, 0)), 0.2);
}

// As poses of an odometry that rises by 3 % of the way.
TEST(GroundMap, TheErrorOfPosesMayGrowWithoutLimit) {
  GroundMap map({.window = 60, .max_correction = 0.5});
  for (double x = 0; x <= 200; x += 2) {
    const Pose pose = upright_pose(hills, x, 0);
    const GroundScan scan(hills, pose);
    const Levelling levelling = add(map, scan, wrong(pose, 0.03 * x, 0));
    EXPECT_TRUE(x == 0 || levelling.applied) << x;
  }
}

// Two runs over one street. The poses of the second one begin elsewhere: 0.3 m higher, tilted.
TEST(GroundMap, TwoRunsOverOneStreetGiveOneMap) {
  constexpr double tilt = 0.5 * 3.14159 / 180;
  GroundMap map;
  for (const bool second : {false, true}) {
    for (double x = 0; x <= 40; x += 4) {
      const Pose pose = upright_pose(hills, x, second ? 3 : 0);
      const GroundScan scan(hills, pose);
      const Levelling levelling = add(map, scan, second ? wrong(pose, 0.3, tilt) : pose);
      if (second) {
        EXPECT_NEAR(levelling.offset, 0.3, 0.02);
        EXPECT_NEAR(std::hypot(levelling.slope_x, levelling.slope_y), tilt, 0.001);
      }
    }
  }

  EXPECT_LT(worst_error(map, hills, 10, 0), 0.02);
  EXPECT_LT(worst_error(map, hills, 30, 3), 0.02);
}

TEST(GroundMap, DoesNotLevelToAnotherStorey) {
  GroundMap map;
  const Pose below = upright_pose(level_ground, 0, 0);
  add(map, GroundScan(level_ground, below), below);
  const auto bridge = [](double, double) { return 6.0; };
  const Pose above = upright_pose(bridge, 0, 0);

  const Levelling levelling = add(map, GroundScan(bridge, above), above);

  EXPECT_FALSE(levelling.applied);
  EXPECT_EQ(levelling.offset, 0);
  EXPECT_GT(levelling.cells, 5000U);
  EXPECT_EQ(map.at(3, 3).contradictions, 1U);
}

TEST(GroundMap, AWrongHeightGivesWayToTheHeightThatMoreScansMeasured) {
  const auto with_roof = [](double x, double y) {
    return std::hypot(x - 8, y) < 2 ? 1.5 : level_ground(x, y);
  };
  GroundMap map;
  const Pose pose = upright_pose(level_ground, 0, 0);
  add(map, GroundScan(with_roof, pose), pose);
  EXPECT_NEAR(map.height(8, 0), 1.5, 0.01);

  add(map, GroundScan(level_ground, pose), pose);
  add(map, GroundScan(level_ground, pose), pose);

  EXPECT_NEAR(map.height(8, 0), 0, 0.01);
  EXPECT_EQ(map.at(8.1, 0.1).contradictions, 1U);
  EXPECT_EQ(map.at(8.1, 0.1).scans, 2U);
}

TEST(GroundMap, AScanThatWasLevelledIsAddedWithTheSameResult) {
  GroundMap at_once;
  GroundMap in_two_steps;
  for (double x = 0; x < 60; x += 5) {
    const Pose pose = wrong(upright_pose(hills, x, 0), 0.01 * x, 0.002);
    const GroundScan scan(hills, pose);
    const Levelling expected = add(at_once, scan, pose);
    Levelling levelling;
    ASSERT_TRUE(in_two_steps.level(scan.view(), scan.result, pose, levelling).ok());
    EXPECT_TRUE(in_two_steps.add_levelled().ok());
    EXPECT_EQ(levelling.offset, expected.offset);
  }
  std::vector<std::byte> expected;
  std::vector<std::byte> bytes;
  ASSERT_TRUE(at_once.to_bytes(expected).ok());
  ASSERT_TRUE(in_two_steps.to_bytes(bytes).ok());
  EXPECT_EQ(bytes, expected);
}

TEST(GroundMap, AddsOnlyAScanThatWasLevelledToTheMapAsItIs) {
  const Pose pose = upright_pose(hills, 0, 0);
  const GroundScan scan(hills, pose);
  GroundMap map;
  Levelling levelling;
  EXPECT_EQ(map.add_levelled().code(), StatusCode::invalid_argument);  // no scan
  ASSERT_TRUE(map.level(scan.view(), scan.result, pose, levelling).ok());
  add(map, scan, pose);
  EXPECT_EQ(map.add_levelled().code(), StatusCode::invalid_argument);  // the map changed
  ASSERT_TRUE(map.level(scan.view(), scan.result, pose, levelling).ok());
  EXPECT_TRUE(map.add_levelled().ok());
  EXPECT_EQ(map.add_levelled().code(), StatusCode::invalid_argument);  // it was added
  EXPECT_EQ(map.scans(), 2U);
}

TEST(GroundMap, AgeCountsTheScansSinceTheLastMeasurement) {
  GroundMap map;
  const Pose here = upright_pose(level_ground, 0, 0);
  const Pose far = upright_pose(level_ground, 500, 0);
  add(map, GroundScan(level_ground, here), here);
  for (int i = 0; i < 3; ++i) add(map, GroundScan(level_ground, far), far);

  EXPECT_EQ(map.at(1, 1).age, 3U);
  EXPECT_EQ(map.at(501, 1).age, 0U);
}

TEST(GroundMap, DoesNotDependOnTheOrderOfThePoints) {
  const Pose pose = upright_pose(hills, 1, 2, 0.3);
  const GroundScan scan(hills, pose);
  // All heights differ, so that sums in another order would be rounded differently.
  std::vector<float> heights(scan.result.heights().size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = 0.07F * std::sin(static_cast<float>(i));
  }
  std::vector<std::size_t> order(heights.size());
  std::iota(order.begin(), order.end(), 0U);
  GroundMap maps[2];
  for (GroundMap& map : maps) {
    GroundScan shuffled = scan;
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) shuffled.xyz[3 * i + k] = scan.xyz[3 * order[i] + k];
      shuffled.xyz[3 * i + 2] += heights[order[i]];
      shuffled.result.start_heights()[i] = heights[order[i]];
    }
    add(map, shuffled, pose);
    std::ranges::shuffle(order, std::mt19937(1));
  }

  for (double x = -30; x < 30; x += 0.7) {
    const double one = maps[0].height(x, 0.5 * x);
    const double other = maps[1].height(x, 0.5 * x);
    EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other))) << x;
  }
}

TEST(GroundMap, MemoryIsBoundedWithAWindow) {
  GroundMap everything;
  GroundMap rolling({.window = 80});
  std::size_t largest = 0;
  for (double x = 0; x < 1000; x += 20) {
    const Pose pose = upright_pose(hills, x, 0);
    const GroundScan scan(hills, pose);
    add(everything, scan, pose);
    add(rolling, scan, pose);
    if (x >= 200) largest = std::max(largest, rolling.bytes());
    if (x == 200) largest = rolling.bytes();
  }

  EXPECT_LT(largest, everything.bytes() / 3);
  EXPECT_TRUE(std::isnan(rolling.height(100, 0)));
  EXPECT_FALSE(std::isnan(rolling.height(980, 0)));
  EXPECT_EQ(rolling.height(980, 3), everything.height(980, 3));
}

TEST(GroundMap, HasNoTilesAtFirst) {
  const GroundMap map;
  MapTile tile;

  EXPECT_TRUE(map.tiles().empty());
  EXPECT_FALSE(map.read_tile({}, tile));
}

TEST(GroundMap, TilesAreSortedByYThenX) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 0, 0);
  add(map, GroundScan(hills, pose), pose);
  const Pose far = upright_pose(hills, -48, 16);
  add(map, GroundScan(hills, far, 10), far);

  // Scans with a radius of 35 m at (0, 0) and of 10 m at (-48, 16), tiles of 32 m.
  const std::vector<TileIndex> expected{{-1, -2}, {0, -2}, {-2, -1}, {-1, -1}, {0, -1}, {1, -1},
                                        {-2, 0},  {-1, 0}, {0, 0},   {1, 0},   {-1, 1}, {0, 1}};
  EXPECT_EQ(map.tiles(), expected);
}

TEST(GroundMap, ATileHasTheValuesOfItsCells) {
  GroundMap map;
  for (const double x : {0.0, 3.0}) {
    const Pose pose = upright_pose(hills, x, 0);
    add(map, GroundScan(hills, pose, 20), pose);
  }
  const double size = map.config().cell;
  MapTile tile;
  std::size_t known = 0;

  for (const TileIndex index : map.tiles()) {
    ASSERT_TRUE(map.read_tile(index, tile));
    for (std::size_t k = 0; k < MapTile::cells; ++k) {
      const auto column = static_cast<double>(k % GroundMap::tile_width);
      const auto row = static_cast<double>(k / GroundMap::tile_width);
      constexpr auto width = static_cast<double>(GroundMap::tile_width);
      const MapSample sample = map.at((static_cast<double>(index.x) * width + column + 0.5) * size,
                                      (static_cast<double>(index.y) * width + row + 0.5) * size);
      ASSERT_EQ(std::isnan(tile.height[k]), std::isnan(sample.height));
      ASSERT_EQ(tile.scans[k], sample.scans);
      ASSERT_EQ(tile.contradictions[k], sample.contradictions);
      if (std::isnan(sample.height)) {
        ASSERT_TRUE(std::isnan(tile.deviation[k]));
        ASSERT_EQ(tile.last_scan[k], 0U);
        continue;
      }
      ++known;
      ASSERT_EQ(tile.height[k], static_cast<float>(sample.height));
      ASSERT_EQ(tile.deviation[k], sample.deviation);
      ASSERT_EQ(map.scans() - tile.last_scan[k], sample.age);
    }
  }
  EXPECT_EQ(known, map.cells());
}

TEST(GroundMap, QueriesAcceptAnyNumber) {
  GroundMap map;
  const Pose pose = upright_pose(level_ground, 0, 0);
  add(map, GroundScan(level_ground, pose), pose);
  constexpr double infinity = std::numeric_limits<double>::infinity();

  for (const double x : {std::nan(""), infinity, -infinity, 1e300, -1e8, 1e17}) {
    EXPECT_TRUE(std::isnan(map.height(x, 0))) << x;
    EXPECT_TRUE(std::isnan(map.at(0, x).height)) << x;
  }
}

/// A scan of the ground with one point `up` metres above it.
struct RaisedScan {
  RaisedScan(const Pose& pose, float up) : scan(hills, pose) {
    labels.assign(scan.result.labels().begin(), scan.result.labels().end());
    raised = labels.size() / 2;
    scan.xyz[3 * raised + 2] += up;
  }

  GroundScan scan;
  std::vector<Label> labels;
  std::size_t raised = 0;  // index of the point
};

// The label of the raised point after a comparison with the map.
Label relabelled(const GroundMap& map, RaisedScan& raised, const Pose& pose) {
  EXPECT_TRUE(map.relabel(raised.scan.view(), raised.scan.result, pose, {}, raised.labels).ok());
  return raised.labels[raised.raised];
}

TEST(GroundMap, PointsFarAboveTheKnownMapAreNotGround) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 3, 4);
  add(map, GroundScan(hills, pose), pose);
  for (const auto& [up, label] : {std::pair(0.2F, Label::ground), {0.35F, Label::nonground}}) {
    RaisedScan raised(pose, up);
    EXPECT_EQ(relabelled(map, raised, pose), label);
    EXPECT_EQ(std::ranges::count(raised.labels, Label::nonground), label == Label::ground ? 0 : 1);
  }
}

TEST(GroundMap, TheMarginAboveTheMapIsSmallerInACellWithAnObstacle) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 3, 4);
  add(map, GroundScan(hills, pose), pose);
  // A point in the same cell, metres above the ground: a wall, and two that are not obstacles.
  for (const auto& [above, label] :
       {std::pair(1.5F, Label::nonground), {0.8F, Label::ground}, {2.6F, Label::ground}}) {
    RaisedScan raised(pose, 0.15F);
    const std::size_t other = raised.raised + 1;
    raised.scan.xyz[3 * other + 2] += above;
    const std::span<float> heights = raised.scan.result.start_heights();
    std::ranges::fill(heights, 0.0F);
    heights[other] = above;
    raised.labels[other] = Label::nonground;
    EXPECT_EQ(relabelled(map, raised, pose), label) << above;
  }
}

TEST(GroundMap, TheMarginAboveTheMapIncludesItsExpectedError) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 3, 4);
  const GroundScan scan(hills, pose);
  add(map, scan, pose);
  RaisedScan raised(pose, 0.26F);
  EXPECT_EQ(relabelled(map, raised, pose), Label::ground);
  for (int i = 0; i < 20; ++i) add(map, scan, pose);
  EXPECT_EQ(relabelled(map, raised, pose), Label::nonground);
}

TEST(GroundMap, OnlyLabelsOfGroundChangeAndOnlyWhereTheMapIsKnown) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 3, 4);
  const Pose far = upright_pose(hills, 300, 4);
  const Levelling levelling = add(map, GroundScan(hills, pose), pose);

  RaisedScan noise(pose, 1);
  noise.labels[noise.raised] = Label::noise;
  ASSERT_TRUE(
      map.relabel(noise.scan.view(), noise.scan.result, pose, levelling, noise.labels).ok());
  EXPECT_EQ(noise.labels[noise.raised], Label::noise);

  RaisedScan unknown(far, 1);
  ASSERT_TRUE(map.relabel(unknown.scan.view(), unknown.scan.result, far, {}, unknown.labels).ok());
  EXPECT_EQ(unknown.labels[unknown.raised], Label::ground);
}

/// A scan of the ground whose surface is 5 cm too low.
struct LowScan {
  explicit LowScan(const Pose& the_pose)
      : pose(the_pose), scan(hills, pose), own(scan.result.labels().size(), error) {}

  static constexpr float error = 0.05F;

  /// The heights of its points, with those of a map.
  [[nodiscard]] std::vector<float> heights(const GroundMap& map, const Levelling& levelling = {}) {
    std::ranges::copy(own, scan.result.start_heights().begin());
    std::vector<float> heights(own.size());
    EXPECT_TRUE(map.heights(scan.view(), scan.result, pose, levelling, heights).ok());
    return heights;
  }

  Pose pose;
  GroundScan scan;
  std::vector<float> own;  // heights above its surface
};

TEST(GroundMap, HeightsFollowTheScanInCellsWithItsGround) {
  GroundMap map;
  LowScan low(upright_pose(hills, 3, 4));
  add(map, GroundScan(hills, low.pose), low.pose);
  EXPECT_THAT(low.heights(map), testing::Each(testing::FloatNear(LowScan::error, 0.005F)));
}

TEST(GroundMap, HeightsDependMoreOnACertainMapThanOnAnUncertainOne) {
  GroundMap map;
  LowScan low(upright_pose(hills, 3, 4));
  const GroundScan scan(hills, low.pose);
  add(map, scan, low.pose);
  const std::vector<float> uncertain = low.heights(map);
  for (int i = 0; i < 20; ++i) add(map, scan, low.pose);
  const std::vector<float> certain = low.heights(map);
  const std::size_t middle = certain.size() / 2;
  EXPECT_LT(certain[middle], uncertain[middle] - 0.001F);
}

TEST(GroundMap, HeightsFollowTheLevelledMapInCellsWithoutGroundInTheScan) {
  GroundMap map;
  LowScan low(upright_pose(hills, 3, 4));
  add(map, GroundScan(hills, low.pose), low.pose);
  const GroundScan scan(hills, low.pose);
  low.pose = wrong(low.pose, 0.4, 0.01);
  const Levelling levelling = add(map, scan, low.pose);
  std::ranges::fill(low.scan.result.mutable_labels(), Label::nonground);
  const std::size_t middle = low.own.size() / 2;
  low.scan.xyz[3 * middle + 2] += 2;
  const std::vector<float> heights = low.heights(map, levelling);
  EXPECT_NEAR(heights[middle], 2, 0.02);
  EXPECT_NEAR(heights[middle + 1], 0, 0.02);
}

TEST(GroundMap, HeightsOfOneSourceAreUsedIfTheOtherIsUnknown) {
  GroundMap map;
  LowScan low(upright_pose(hills, 3, 4));
  EXPECT_THAT(low.heights(map), testing::Each(LowScan::error));

  add(map, GroundScan(hills, low.pose), low.pose);
  const std::size_t middle = low.own.size() / 2;
  low.own[middle] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NEAR(low.heights(map)[middle], 0, 0.005);
}

TEST(GroundMap, PointsThatAreInvalidOrOutOfRangeKeepTheirHeight) {
  GroundMap map;
  LowScan low(upright_pose(hills, 3, 4));
  add(map, GroundScan(hills, low.pose), low.pose);
  const std::size_t middle = low.own.size() / 2;
  for (const Label label : {Label::invalid, Label::out_of_range}) {
    low.scan.result.mutable_labels()[middle] = label;
    low.own[middle] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(low.heights(map)[middle])) << to_string(label);
  }
}

TEST(GroundMap, RejectsValuesThatAreNotOnePerPoint) {
  GroundMap map;
  const Pose pose = upright_pose(hills, 3, 4);
  const GroundScan scan(hills, pose);
  std::vector<float> heights(scan.result.labels().size() - 1);
  std::vector<Label> labels(scan.result.labels().size() + 1);
  EXPECT_THAT(map.heights(scan.view(), scan.result, pose, {}, heights).message(),
              testing::HasSubstr("the number of heights differs from the number of points"));
  EXPECT_THAT(map.relabel(scan.view(), scan.result, pose, {}, labels).message(),
              testing::HasSubstr("the number of labels differs from the number of points"));
}

TEST(GroundMap, RejectsInvalidPosesAndStaysAsItWas) {
  GroundMap map;
  const Pose good = upright_pose(level_ground, 0, 0);
  const GroundScan scan(level_ground, good);
  add(map, scan, good);
  std::vector<Pose> bad(5, good);
  bad[0].position[1] = std::nan("");
  bad[1].position[0] = 1e9;
  bad[2].rotation[0] = std::nan("");
  bad[3].rotation[0] = 1.1;
  bad[4].rotation = {1, 0, 0, 0, 1, 0, 0, 0, -1};

  for (const Pose& pose : bad) {
    Levelling levelling;
    const Status status = map.add(scan.view(), scan.result, pose, levelling);

    EXPECT_EQ(status.code(), StatusCode::invalid_argument);
    EXPECT_THAT(status.message(), testing::HasSubstr("expected finite numbers"));
    EXPECT_EQ(map.scans(), 1U);
  }
}

TEST(GroundMap, RejectsResultsOfAnotherCloudOrWithoutHeights) {
  GroundMap map;
  const Pose pose = upright_pose(level_ground, 0, 0);
  const GroundScan scan(level_ground, pose);
  Segmentation without_heights;
  without_heights.start(scan.view().size());
  Levelling levelling;

  EXPECT_EQ(map.add(CloudView(scan.xyz.data(), 5), scan.result, pose, levelling).code(),
            StatusCode::invalid_argument);
  EXPECT_EQ(map.add(scan.view(), without_heights, pose, levelling).code(),
            StatusCode::invalid_argument);
  EXPECT_EQ(map.scans(), 0U);
}

TEST(GroundMap, AcceptsAnEmptyScan) {
  GroundMap map;
  const Pose pose = upright_pose(level_ground, 0, 0);
  Levelling levelling;

  EXPECT_TRUE(map.add(CloudView(), Segmentation(), pose, levelling).ok());

  EXPECT_FALSE(levelling.applied);
  EXPECT_EQ(map.scans(), 1U);
  EXPECT_EQ(map.cells(), 0U);
}

TEST(GroundMapConfig, RejectsValuesOutOfRange) {
  EXPECT_NO_THROW(GroundMapConfig{}.check());
  const GroundMapConfig invalid[] = {{.cell = 0.05},   {.cell = std::nan("")},
                                     {.max_range = 4}, {.window = 20},
                                     {.window = -1},   {.max_correction = -1}};
  for (const GroundMapConfig& config : invalid) {
    EXPECT_THROW(GroundMap{config}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace flagstone
