// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "flagstone/mount.hpp"
#include "library/mount/yard.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::degrees_between;
using tests::scan_of;
using tests::Yard;
using tests::YardScan;

MountDecision estimated(const YardScan& scan, TiltSource tilt = TiltSource::off) {
  return MountEstimator({.tilt = tilt}).estimate(scan.view());
}

/// Expects an accepted estimate within these errors (metres, degrees), with and without estimating
/// the tilt.
void expect_told(const Yard& yard, float height_error, float tilt_error) {
  const YardScan scan = scan_of(yard);

  const MountDecision height = estimated(scan);
  const MountDecision both = estimated(scan, TiltSource::estimate);

  EXPECT_TRUE(height.accepted()) << to_sentence(height);
  EXPECT_NEAR(height.mount.sensor_height, scan.mount.sensor_height, height_error);
  EXPECT_EQ(height.mount.up, (std::array<float, 3>{0, 0, 1}));
  EXPECT_TRUE(both.accepted()) << to_sentence(both);
  EXPECT_NEAR(both.mount.sensor_height, scan.mount.sensor_height, height_error);
  EXPECT_LE(degrees_between(both.mount.up, scan.mount.up), tilt_error);
}

TEST(MountEstimator, FindsTheHeightAboveFlatGroundToACentimetre) { expect_told({}, 0.015f, 0.2f); }

TEST(MountEstimator, FindsAnyHeightWithinTheLimits) {
  for (const double height : {0.4, 1.0, 2.5, 4.0}) {
    SCOPED_TRACE(height);
    expect_told({.mounting = {.height = height}}, 0.03f, 0.3f);
  }
}

TEST(MountEstimator, OnASlopeUpIsPerpendicularToTheSlope) {
  expect_told({.ground = [](double x, double) { return 0.25 * x; }}, 0.015f, 0.2f);
  expect_told({.ground = [](double x, double y) { return 0.2 * x - 0.15 * y; }}, 0.015f, 0.2f);
}

TEST(MountEstimator, OnACrestAndInADipUsesTheGroundBelowTheVehicle) {
  expect_told({.ground = [](double x, double) { return -0.006 * x * x; }}, 0.06f, 0.5f);
  expect_told({.ground = [](double x, double) { return 0.006 * x * x; }}, 0.06f, 0.5f);
}

TEST(MountEstimator, IgnoresASlopeThatBeginsAhead) {
  expect_told({.ground = [](double x, double) { return x > 6 ? 0.2 * (x - 6) : 0.0; }}, 0.05f, 1);
}

TEST(MountEstimator, IgnoresARaisedSidewalkBehindAKerb) {
  expect_told({.ground = [](double, double y) { return y > 3 ? 0.15 : 0.0; }}, 0.04f, 1);
}

TEST(MountEstimator, NextToATruckGroundOnOneSideIsEnough) {
  expect_told({.boxes = {{.low = {-7, 1.4, 0.9}, .high = {7, 4, 4}}}}, 0.02f, 0.5f);
}

TEST(MountEstimator, NextToAWallGroundOnOneSideIsEnough) {
  expect_told({.boxes = {{.low = {-30, 1.5, -1}, .high = {30, 2, 12}}}}, 0.02f, 0.5f);
}

TEST(MountEstimator, IgnoresTheWallsOfANarrowLane) {
  expect_told({.boxes = {{.low = {-30, 2, -1}, .high = {30, 2.5, 12}},
                         {.low = {-30, -3, -1}, .high = {30, -2.5, 12}}}},
              0.04f, 2);
}

TEST(MountEstimator, IgnoresTheRoofsOfCarsInRows) {
  Yard yard;
  for (int i = -4; i <= 4; ++i) {
    for (const double y : {-4.4, 2.6}) {
      yard.boxes.push_back({.low = {4.8 * i, y, 0.25}, .high = {4.8 * i + 4.3, y + 1.8, 1.45}});
    }
  }

  expect_told(yard, 0.03f, 0.7f);
}

TEST(MountEstimator, IgnoresTheRoofOfTheEgoVehicle) {
  expect_told({.boxes = {{.low = {-2.4, -0.9, 1.2}, .high = {1.2, 0.9, 1.45}},
                         {.low = {1.2, -0.9, 0.4}, .high = {2.1, 0.9, 0.9}}}},
              0.02f, 0.3f);
}

TEST(MountEstimator, SixteenBeamsAreEnough) {
  expect_told({.sensor = "vlp-16"}, 0.03f, 0.4f);
  expect_told({.sensor = "vlp-16", .mounting = {.height = 0.5}}, 0.03f, 0.4f);
}

TEST(MountEstimator, ANarrowFieldOfViewIsEnough) {
  expect_told({.sensor = "livox-avia", .mounting = {.height = 1.5}}, 0.05f, 1);
}

TEST(MountEstimator, FindsGroundThatBeginsFarAheadNextToParkedCars) {
  Yard yard{.sensor = "at128", .mounting = {.height = 2.6}};  // sees no ground nearer than 11.4 m
  for (int i = 0; i < 7; ++i) {
    yard.boxes.push_back({.low = {5.2 * i, 3.4, 0.25}, .high = {5.2 * i + 4.3, 5.2, 1.45}});
  }

  expect_told(yard, 0.15f, 1.5f);
}

TEST(MountEstimator, IgnoresSparseGhostPointsOfACeilingReflectedInTheFloor) {
  YardScan scan;
  for (float x = -10; x < 10; x += 0.1f) {
    for (float y = -10; y < 10; y += 0.1f) scan.points.push_back({x, y, -0.9f});
  }
  for (float x = -10; x < 10; x += 0.5f) {  // one per 25 points of the floor
    for (float y = -10; y < 10; y += 0.5f) scan.points.push_back({x, y, -3.1f});
  }

  for (const TiltSource tilt : {TiltSource::off, TiltSource::estimate}) {
    const MountDecision decision = estimated(scan, tilt);

    EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
    EXPECT_NEAR(decision.mount.sensor_height, 0.9f, 0.02f);
  }
}

/// Pitch and roll, degrees.
class TiltedMount : public testing::TestWithParam<std::array<double, 2>> {};

TEST_P(TiltedMount, IsFoundToADegree) {
  const auto [pitch, roll] = GetParam();
  Yard yard{.mounting = {.height = 1.73, .pitch = pitch, .roll = roll}};
  yard.boxes = {{.low = {-20, 5, -1}, .high = {20, 6, 6}}, {.low = {4, -4, 0}, .high = {8, -2, 2}}};
  const YardScan scan = scan_of(yard);

  const MountDecision decision = estimated(scan, TiltSource::estimate);

  EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
  EXPECT_LE(degrees_between(decision.mount.up, scan.mount.up), 1);
  EXPECT_NEAR(decision.mount.sensor_height, 1.73f, 0.03f);
  EXPECT_NEAR(decision.tilt, degrees_between(scan.mount.up, {0, 0, 1}), 1);
}

INSTANTIATE_TEST_SUITE_P(Tilts, TiltedMount,
                         testing::Values(std::array<double, 2>{5, 0}, std::array<double, 2>{-10, 0},
                                         std::array<double, 2>{20, 0}, std::array<double, 2>{30, 0},
                                         std::array<double, 2>{0, -20},
                                         std::array<double, 2>{0, 30},
                                         std::array<double, 2>{15, 15},
                                         std::array<double, 2>{-20, 20}));

TEST(MountEstimator, SearchesTheTiltNearTheConfiguredUp) {
  const YardScan scan = scan_of({.mounting = {.height = 1.73, .pitch = 50}});
  MountSettings settings{.tilt = TiltSource::estimate};
  settings.mount.up = {-0.64f, 0, 0.77f};  // 40 degrees

  const MountDecision around_z = estimated(scan, TiltSource::estimate);
  const MountDecision around_given = MountEstimator(settings).estimate(scan.view());

  EXPECT_FALSE(around_z.accepted());
  EXPECT_TRUE(around_given.accepted()) << to_sentence(around_given);
  EXPECT_LE(degrees_between(around_given.mount.up, scan.mount.up), 1);
}

TEST(MountEstimator, FindsTheHeightOfAnInvertedSensor) {
  YardScan scan = scan_of({});
  for (Point& p : scan.points) p = {p.x, -p.y, -p.z};
  MountSettings settings{.tilt = TiltSource::estimate};
  settings.mount.up = {0, 0, -1};

  const MountDecision decision = MountEstimator(settings).estimate(scan.view());

  EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
  EXPECT_NEAR(decision.mount.sensor_height, 1.73f, 0.02f);
  EXPECT_LE(degrees_between(decision.mount.up, {0, 0, -1}), 0.3f);
}

TEST(MountEstimator, MeasuresTheHeightAlongTheConfiguredUp) {
  const YardScan scan = scan_of({.mounting = {.height = 1.73, .pitch = 20}});
  MountSettings settings{.tilt = TiltSource::fixed};
  for (std::size_t i = 0; i < 3; ++i) settings.mount.up[i] = 9.81f * scan.mount.up[i];

  const MountDecision decision = MountEstimator(settings).estimate(scan.view());

  EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
  EXPECT_NEAR(decision.mount.sensor_height, 1.73f, 0.02f);
  EXPECT_LE(degrees_between(decision.mount.up, scan.mount.up), 0.1f);
}

TEST(MountEstimator, ToleratesZerosNansAndGhostPointsFarBelow) {
  YardScan scan = scan_of({});
  const std::size_t returns = scan.points.size();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < returns; ++i) {
    scan.points.push_back(i % 2 == 0 ? Point{0, 0, 0} : Point{nan, 1, 1});
    if (i % 25 == 0) {
      Point ghost = scan.points[i];
      ghost.z -= 1 + static_cast<float>(i % 7);
      scan.points.push_back(ghost);
    }
  }

  const MountDecision decision = estimated(scan, TiltSource::estimate);

  EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
  EXPECT_NEAR(decision.mount.sensor_height, 1.73f, 0.02f);
  EXPECT_LE(degrees_between(decision.mount.up, {0, 0, 1}), 0.5f);
}

TEST(MountEstimator, AppliesScaleAndOrigin) {
  YardScan scan = scan_of({});
  for (Point& p : scan.points) {
    p = {1000 * (p.x + 1.2f), 1000 * p.y,
         1000 * (p.z + 1.73f)};  // in millimetres, origin on the ground
  }
  MountSettings settings;
  settings.mount.scale = 0.001f;
  settings.mount.origin = {1.2f, 0, 1.73f};

  const MountDecision decision = MountEstimator(settings).estimate(scan.view());

  EXPECT_TRUE(decision.accepted()) << to_sentence(decision);
  EXPECT_NEAR(decision.mount.sensor_height, 1.73f, 0.02f);
  EXPECT_EQ(decision.mount.scale, 0.001f);
  EXPECT_EQ(decision.mount.origin, settings.mount.origin);
}

TEST(MountEstimator, IsBitIdenticalWhateverWasEstimatedPreviously) {
  const YardScan scan = scan_of({.mounting = {.height = 1.73, .pitch = 12}});
  MountEstimator estimator({.tilt = TiltSource::estimate});
  const MountDecision first = estimator.estimate(scan.view());

  static_cast<void>(estimator.estimate(tests::view_of(tests::corrupted_cloud(20000, 3))));
  const MountDecision second = estimator.estimate(scan.view());

  EXPECT_EQ(first.mount.sensor_height, second.mount.sensor_height);
  EXPECT_EQ(first.mount.up, second.mount.up);
  EXPECT_EQ(first.confidence, second.confidence);
  EXPECT_EQ(first.points, second.points);
}

TEST(MountEstimator, AcceptsCoordinatesOfAnyValueAndReturnsNumbers) {
  for (const TiltSource tilt : {TiltSource::off, TiltSource::estimate}) {
    MountEstimator estimator({.tilt = tilt});
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      std::vector<Point> cloud = tests::corrupted_cloud(3000, seed);
      std::uint32_t bits = seed;
      for (Point& p : cloud) {
        if ((bits = bits * 1664525 + 1013904223) % 3 == 0) std::memcpy(&p.z, &bits, sizeof bits);
      }

      const MountDecision decision = estimator.estimate(tests::view_of(cloud));

      EXPECT_TRUE(std::isfinite(decision.mount.sensor_height));
      EXPECT_NEAR(degrees_between(decision.mount.up, {0, 0, 1}), decision.tilt, 0.1f);
      EXPECT_GE(decision.confidence, 0);
      EXPECT_LE(decision.confidence, 1);
    }
  }
}

}  // namespace
}  // namespace flagstone
