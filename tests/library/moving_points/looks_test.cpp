// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/looks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/moving_points/box_scene.hpp"

namespace flagstone {
namespace {

constexpr PixelGrid grid{.rows_per_radian = static_cast<float>(180 / std::numbers::pi)};

RangeImage image_of(const BoxScan& scan) {
  PointArrays points;
  std::vector<std::uint8_t> is_object;
  points.start(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    points.push_back(scan.view()[i]);
    is_object.push_back(scan.box_of_points[i] != BoxScan::no_box ? 1 : 0);
  }
  points.finish();
  Directions directions;
  directions.compute(points, identity_transform, grid);
  RangeImage image;
  image.build(directions, is_object);
  return image;
}

// The look from the scan at the point (x, y, z), sensor frame.
LookCounts look_at(const BoxScan& scan, float x, float y, float z) {
  PointArrays points;
  points.start(1);
  points.push_back({x, y, z});
  points.finish();
  Directions directions;
  directions.compute(points, identity_transform, grid);
  std::vector<LookCounts> counts(1);
  add_looks(image_of(scan), directions, counts);
  return counts[0];
}

const Pose origin = sensor_at(0, 0);
const Box car{.x = 15};
const Box wall{.x = 30, .length = 0.5, .width = 20, .height = 4};

TEST(Looks, APointOnAnObjectIsOccupied) {
  const LookCounts counts = look_at(BoxScan({car}, origin), 13, 0, -1);
  EXPECT_EQ(counts.occupied, 1);
  EXPECT_EQ(counts.through, 0);
}

TEST(Looks, APointInFrontOfAWallIsSeenThrough) {
  const LookCounts counts = look_at(BoxScan({wall}, origin), 13, 0, -0.3F);
  EXPECT_EQ(counts.occupied, 0);
  EXPECT_EQ(counts.through, 1);
}

TEST(Looks, APointAboveGroundThatWasSeenBehindItIsSeenThrough) {
  EXPECT_EQ(look_at(BoxScan({}, origin), 13, 0, -1).through, 1);
}

TEST(Looks, NothingIsKnownOfAPointBehindAnObject) {
  const LookCounts counts = look_at(BoxScan({car, wall}, origin), 22, 0, -1);
  EXPECT_EQ(counts.occupied, 0);
  EXPECT_EQ(counts.through, 0);
}

TEST(Looks, NothingIsKnownInDirectionsWithoutMeasurements) {
  const LookCounts counts = look_at(BoxScan({wall}, origin), -20, 0, 5);
  EXPECT_EQ(counts.occupied, 0);
  EXPECT_EQ(counts.through, 0);
}

TEST(Looks, APointNextToTheEdgeOfANearerObjectIsNotSeenThrough) {
  // The car covers 1 m to each side at 13 m: 4.4 degrees.
  const BoxScan scan({car, wall}, origin);
  EXPECT_EQ(look_at(scan, 20, 1.60F, -0.6F).through, 0);
  EXPECT_EQ(look_at(scan, 20, 2.50F, -0.6F).through, 1);
}

TEST(Looks, AreTheSameOnEveryInstructionSet) {
  const BoxScan scan({car, wall}, origin);
  const auto looks = [&] {
    PointArrays points;
    points.start(1000);
    for (int k = 0; k < 1000; ++k) {
      points.push_back({0.04F * static_cast<float>(k), 0.3F * static_cast<float>(k % 11 - 5),
                        0.5F * static_cast<float>(k % 7) - 2});
    }
    points.finish();
    Directions directions;
    directions.compute(points, identity_transform, grid);
    std::vector<LookCounts> counts(points.size());
    add_looks(image_of(scan), directions, counts);
    std::vector<int> numbers;
    for (const LookCounts& each : counts) numbers.push_back(2 * each.through + each.occupied);
    return numbers;
  };
  const std::vector<int> expected = looks();
  EXPECT_THAT(expected, testing::IsSupersetOf({0, 1, 2}));
  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    EXPECT_EQ(looks(), expected) << target;
  }
}

std::deque<ScanView> scans_at(const std::vector<double>& times) {
  std::deque<ScanView> scans;
  for (const double time : times) scans.emplace_back().time = time;
  return scans;
}

std::vector<double> times_of(const std::deque<ScanView>& scans, double time) {
  std::vector<const ScanView*> views;
  select_views(scans, time, views);
  std::vector<double> times;
  for (const ScanView* view : views) times.push_back(view->time);
  return times;
}

TEST(SelectViews, ChoosesScansBeforeAndAfter) {
  std::vector<double> times;
  for (int k = 0; k <= 200; ++k) times.push_back(0.1 * k);
  const std::vector<double> selected = times_of(scans_at(times), 10);
  ASSERT_EQ(selected.size(), 34U);
  for (std::size_t k = 0; k < 17; ++k) {
    EXPECT_LT(selected[k], 10);
    EXPECT_NEAR(10 - selected[k], selected[k + 17] - 10, 0.001);
  }
  EXPECT_NEAR(selected.front(), 9.7, 0.001);
  EXPECT_NEAR(selected[16], 2, 0.001);
}

TEST(SelectViews, TimesOfAnyClockSelectTheSameScans) {
  std::vector<double> times;
  std::vector<double> of_clock;
  for (int k = 0; k <= 200; ++k) {
    times.push_back(0.25 * k);
    of_clock.push_back(1.7e9 + 0.25 * k);
  }
  const std::vector<double> selected = times_of(scans_at(times), times[90]);
  const std::vector<double> selected_of_clock = times_of(scans_at(of_clock), of_clock[90]);
  ASSERT_EQ(selected.size(), selected_of_clock.size());
  for (std::size_t k = 0; k < selected.size(); ++k) {
    EXPECT_NEAR(selected[k], selected_of_clock[k] - 1.7e9, 1e-3);
  }
}

TEST(SelectViews, UsesEveryScanOnceIfThereAreFew) {
  EXPECT_EQ(times_of(scans_at({0, 1, 2, 3, 4}), 2), (std::vector<double>{1, 0, 3, 4}));
}

TEST(SelectViews, ShortensTheIntervalsForShortRuns) {
  std::vector<double> times;
  for (int k = 0; k < 10; ++k) times.push_back(0.1 * k);
  EXPECT_GE(times_of(scans_at(times), 0.9).size(), 5U);
}

TEST(SelectViews, AScanIsNotComparedWithItself) {
  EXPECT_TRUE(times_of(scans_at({3}), 3).empty());
  EXPECT_TRUE(times_of({}, 3).empty());
}

}  // namespace
}  // namespace flagstone
