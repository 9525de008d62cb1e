// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/moving_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "library/moving_points/box_scene.hpp"

namespace flagstone {
namespace {

constexpr double rate = 5;  // scans per second

// A car that drives along the other lane at 8 m/s, a parked car and a house, at a time in seconds.
enum : int { driving, parked, house };
std::vector<Box> street(double time) {
  return {{.x = 45 - 8 * time, .y = 4},
          {.x = 25, .y = -4},
          {.x = 30, .y = 12, .length = 30, .width = 4, .height = 8}};
}

/// The scans of a sensor that drives along that street at 6 m/s.
class Street {
 public:
  explicit Street(double seconds) {
    for (int k = 0; k <= static_cast<int>(seconds * rate); ++k) {
      const double time = k / rate;
      times.push_back(time);
      poses.push_back(sensor_at(6 * time, 0));
      scans.emplace_back(street(time), poses.back());
    }
  }
  Status add(MovingPoints& moving, std::size_t k, MovingMask& mask) const {
    return moving.add(scans[k].view(), scans[k].result, poses[k], {}, times[k], mask);
  }
  Status find(MovingPoints& moving, std::size_t k, MovingMask& mask) const {
    return moving.find(scans[k].view(), scans[k].result, poses[k], {}, times[k], mask);
  }

  std::vector<double> times;
  std::vector<Pose> poses;
  std::vector<BoxScan> scans;
};

/// Fraction of the points of a box, at least 0.3 m above the ground, that move.
double moving_fraction(const BoxScan& scan, const MovingMask& mask, int box) {
  double all = 0;
  double moving = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.box_of_points[i] != box || scan.result.heights()[i] < 0.3F) continue;
    ++all;
    moving += mask.objects_of_points[i] != 0 ? 1 : 0;
  }
  return all > 0 ? moving / all : 0;
}

TEST(MovingPoints, ADrivingCarIsFoundAtOnceAndAParkedOneIsNot) {
  const Street run(4);
  MovingPoints moving;
  MovingMask mask;
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    ASSERT_TRUE(run.add(moving, k, mask).ok());
    // Its far side appears when the sensor is next to it. Until then, others looked past it.
    EXPECT_LT(moving_fraction(run.scans[k], mask, parked), 0.06) << k;
    EXPECT_EQ(moving_fraction(run.scans[k], mask, house), 0) << k;
    if (run.times[k] >= 2) {
      EXPECT_GT(moving_fraction(run.scans[k], mask, driving), 0.9) << k;
    }
  }
}

TEST(MovingPoints, TheFirstScanHasNoMovingPointsUntilLaterOnesAreAdded) {
  const Street run(5);
  MovingPoints moving({.delay = 5});
  MovingMask mask;
  ASSERT_TRUE(run.add(moving, 0, mask).ok());
  EXPECT_TRUE(mask.objects.empty());
  for (std::size_t k = 1; k < run.scans.size(); ++k) ASSERT_TRUE(run.add(moving, k, mask).ok());
  ASSERT_TRUE(run.find(moving, 0, mask).ok());
  EXPECT_GT(moving_fraction(run.scans[0], mask, driving), 0.8);
  EXPECT_LT(moving_fraction(run.scans[0], mask, parked), 0.02);
}

TEST(MovingPoints, ObjectsHaveABoxAndAConfidence) {
  const Street run(2);
  MovingPoints moving;
  MovingMask mask;
  for (std::size_t k = 0; k < run.scans.size(); ++k) ASSERT_TRUE(run.add(moving, k, mask).ok());
  ASSERT_EQ(mask.objects.size(), 1U);
  const MovingObject& object = mask.objects[0];
  // The car at 2 s is 29 - 12 m ahead of the sensor.
  EXPECT_NEAR(object.min[0], 15, 0.3);
  EXPECT_NEAR(object.max[0], 19, 1);  // its far end has few points
  EXPECT_NEAR(object.min[1], 3, 0.3);
  EXPECT_NEAR(object.max[2], 1.6 - 1.8, 0.4);
  EXPECT_GT(object.confidence, 0.6F);
  EXPECT_LE(object.confidence, 1);
  const auto count = std::ranges::count(mask.objects_of_points, 1U);
  EXPECT_EQ(object.points, static_cast<std::size_t>(count));
}

TEST(MovingPoints, GroundNeverMoves) {
  const Street run(3);
  MovingPoints moving;
  MovingMask mask;
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    ASSERT_TRUE(run.add(moving, k, mask).ok());
    EXPECT_EQ(moving_fraction(run.scans[k], mask, BoxScan::no_box), 0);
  }
}

TEST(MovingPoints, TheOrderOfThePointsDoesNotMatter) {
  const Street run(2);
  MovingPoints moving;
  MovingPoints moving_of_shuffled;
  MovingMask mask;
  MovingMask mask_of_shuffled;
  std::mt19937 random(1);
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    const BoxScan& scan = run.scans[k];
    std::vector<std::size_t> order(scan.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::shuffle(order, random);
    BoxScan shuffled = scan;
    const auto labels = shuffled.result.start(scan.size());
    const auto heights = shuffled.result.start_heights();
    for (std::size_t i = 0; i < order.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) shuffled.xyz[3 * i + c] = scan.xyz[3 * order[i] + c];
      labels[i] = scan.result.labels()[order[i]];
      heights[i] = scan.result.heights()[order[i]];
    }
    ASSERT_TRUE(run.add(moving, k, mask).ok());
    ASSERT_TRUE(
        moving_of_shuffled
            .add(shuffled.view(), shuffled.result, run.poses[k], {}, run.times[k], mask_of_shuffled)
            .ok());
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(mask_of_shuffled.objects_of_points[i], mask.objects_of_points[order[i]]);
    }
  }
}

TEST(MovingPoints, MemoryIsBounded) {
  const BoxScan scan(street(0), sensor_at(0, 0));
  MovingPoints moving({.delay = 1, .window = 100});
  MovingMask mask;
  for (int k = 0; k < 60; ++k) {
    ASSERT_TRUE(moving.add(scan.view(), scan.result, sensor_at(5 * k, 0), {}, k, mask).ok());
  }
  EXPECT_EQ(moving.scans(), 10U);
  EXPECT_LT(moving.bytes(), 20U << 20U);
}

TEST(MovingPoints, LevellingIsPartOfThePose) {
  const Street run(3);
  MovingPoints moving;
  MovingMask mask;
  for (std::size_t k = 0; k < run.scans.size(); ++k) {
    // Poses with errors of 1 m, and levellings that remove them.
    const double error = k % 2 == 0 ? 1 : -1;
    Pose pose = run.poses[k];
    pose.position[2] += error;
    const Levelling levelling{.applied = true, .cells = 1000, .offset = error};
    ASSERT_TRUE(
        moving.add(run.scans[k].view(), run.scans[k].result, pose, levelling, run.times[k], mask)
            .ok());
    EXPECT_EQ(moving_fraction(run.scans[k], mask, house), 0);
  }
  EXPECT_GT(moving_fraction(run.scans.back(), mask, driving), 0.95);
}

TEST(MovingPoints, ErrorsAreReportedAndChangeNothing) {
  const Street run(1);
  MovingPoints moving;
  MovingMask mask;
  ASSERT_TRUE(run.add(moving, 1, mask).ok());
  const BoxScan& scan = run.scans[2];
  const auto add = [&](const Pose& pose, const Segmentation& result, double time) {
    return moving.add(scan.view(), result, pose, {}, time, mask).code();
  };
  Segmentation other;
  Pose bad = run.poses[2];
  bad.position[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(add(run.poses[2], other, 1), StatusCode::invalid_argument);
  EXPECT_EQ(add(bad, scan.result, 1), StatusCode::invalid_argument);
  EXPECT_EQ(add(run.poses[2], scan.result, run.times[1]), StatusCode::invalid_argument);
  EXPECT_EQ(add(run.poses[2], scan.result, std::numeric_limits<double>::quiet_NaN()),
            StatusCode::invalid_argument);
  EXPECT_EQ(run.find(moving, 2, mask).code(), StatusCode::invalid_argument);
  EXPECT_EQ(moving.scans(), 1U);
  EXPECT_TRUE(run.add(moving, 2, mask).ok());
}

TEST(MovingPoints, AnEmptyScanHasNoMovingPoints) {
  MovingPoints moving;
  MovingMask mask;
  Segmentation result;
  result.start(0);
  result.start_heights();
  EXPECT_TRUE(moving.add({}, result, {}, {}, 1, mask).ok());
  EXPECT_TRUE(mask.objects_of_points.empty());
  EXPECT_TRUE(moving.find({}, result, {}, {}, 1, mask).ok());
}

TEST(MovingPoints, SettingsAreChecked) {
  const auto is_rejected = [](const MovingPointsConfig& config) {
    EXPECT_THROW(MovingPoints{config}, std::invalid_argument);
  };
  is_rejected({.beam_spacing = 0.01});
  is_rejected({.max_range = 1000});
  is_rejected({.min_height = -1});
  is_rejected({.delay = 11});
  is_rejected({.window = 20});
  EXPECT_NO_THROW(MovingPoints({.beam_spacing = 2, .delay = 0, .window = 200}));
}

TEST(MovingPoints, TheBeamSpacingIsMeasured) {
  const Street run(0.2);
  MovingPoints moving;
  EXPECT_EQ(moving.beam_spacing(), 0);
  MovingMask mask;
  ASSERT_TRUE(run.add(moving, 0, mask).ok());
  EXPECT_NEAR(moving.beam_spacing(), 1, 0.051);
}

}  // namespace
}  // namespace flagstone
