// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Estimates from clouds without ground are rejected with the reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "flagstone/mount.hpp"
#include "library/mount/yard.hpp"

namespace flagstone {
namespace {

using testing::HasSubstr;
using tests::level_ground;

MountDecision decided(const std::vector<Point>& points, const MountSettings& settings = {}) {
  return MountEstimator(settings).estimate(CloudView(std::span<const Point>(points)));
}

/// Four walls around the sensor, from z = `low` to z = `high`.
std::vector<Point> walls(float low, float high) {
  std::vector<Point> points;
  for (float along = -6; along < 6; along += 0.1f) {
    for (float z = low; z < high; z += 0.1f) {
      points.insert(points.end(), {{6, along, z}, {-6, along, z}, {along, 6, z}, {along, -6, z}});
    }
  }
  return points;
}

TEST(MountRejection, OfAnEmptyCloud) {
  const MountDecision decision = decided({});

  EXPECT_EQ(decision.verdict, MountVerdict::too_few_points);
  EXPECT_EQ(decision.confidence, 0);
  EXPECT_EQ(decision.mount.sensor_height, 1.73f);  // the configured height
}

TEST(MountRejection, OfANullCloudWithPoints) {
  const MountDecision decision = MountEstimator().estimate(CloudView(nullptr, 1000));

  EXPECT_EQ(decision.verdict, MountVerdict::too_few_points);
}

TEST(MountRejection, OfACloudOfZeros) {
  EXPECT_EQ(decided(std::vector<Point>(5000)).verdict, MountVerdict::too_few_points);
}

TEST(MountRejection, OfAFewPoints) {
  std::vector<Point> points = level_ground(1.73f);
  points.resize(60);

  const MountDecision decision = decided(points);

  EXPECT_EQ(decision.verdict, MountVerdict::too_few_points);
  EXPECT_THAT(to_sentence(decision), HasSubstr("too few points"));
}

TEST(MountRejection, OfWallsWithoutGround) {
  const MountDecision decision = decided(walls(-1.7f, 3));

  EXPECT_EQ(decision.verdict, MountVerdict::obstructed);
  EXPECT_LT(decision.confidence, 0.1f);
  EXPECT_THAT(to_sentence(decision), HasSubstr("at the base of objects"));
}

TEST(MountRejection, OfWallsWithoutGroundIfTheTiltIsEstimated) {
  EXPECT_FALSE(decided(walls(-1.7f, 3), {.tilt = TiltSource::estimate}).accepted());
}

TEST(MountRejection, OfATableNextToALowerFloor) {
  std::vector<Point> points;
  for (float x = -4; x < 4; x += 0.1f) {
    for (float y = -4; y < 4; y += 0.1f) points.push_back({x, y, -0.5f});
  }
  for (float x = -12; x < 12; x += 0.3f) {  // floor that drops to 10 m below
    for (float y = 4; y < 12; y += 0.3f) points.push_back({x, y, -3 - 0.9f * (y - 4)});
  }

  const MountDecision decision = decided(points);

  EXPECT_EQ(decision.verdict, MountVerdict::points_below) << to_sentence(decision);
  EXPECT_THAT(to_sentence(decision), HasSubstr("too many points below the best plane"));
}

TEST(MountRejection, OfACloudWithoutAPlane) {
  std::vector<Point> points;
  std::uint32_t random = 1;
  const auto uniform = [&random] {
    random = random * 1664525 + 1013904223;
    return static_cast<float>(random >> 8) / 16777216.0f;
  };
  for (int i = 0; i < 20000; ++i) {
    points.push_back({20 * uniform() - 10, 20 * uniform() - 10, 8 * uniform() - 8});
  }

  EXPECT_FALSE(decided(points).accepted());
  EXPECT_FALSE(decided(points, {.tilt = TiltSource::estimate}).accepted());
}

TEST(MountRejection, OfAHeightOutsideTheLimits) {
  MountSettings settings;
  settings.limits.min_height = 1;
  settings.limits.max_height = 3;

  EXPECT_EQ(decided(level_ground(1.73f), settings).verdict, MountVerdict::accepted);
  EXPECT_EQ(decided(level_ground(0.9f), settings).verdict, MountVerdict::height_limit);
  EXPECT_FALSE(decided(level_ground(4), settings).accepted());
}

TEST(MountRejection, OfATiltAboveTheLimit) {
  const tests::YardScan scan = tests::scan_of({.mounting = {.height = 1.73, .pitch = 12}});
  MountSettings settings{.tilt = TiltSource::estimate};
  settings.limits.max_tilt = 10;

  const MountDecision decision = MountEstimator(settings).estimate(scan.view());

  EXPECT_EQ(decision.verdict, MountVerdict::tilt_limit);
  EXPECT_NEAR(decision.tilt, 12, 1);
  EXPECT_THAT(to_sentence(decision),
              HasSubstr("the tilt exceeds the limit (rejected estimate: sensor 1.7"));
}

TEST(MountRejection, OfAConfidenceBelowTheMinimum) {
  MountSettings settings;
  std::vector<Point> few = level_ground(1.73f);
  std::erase_if(few, [](const Point& p) { return p.x < 0 || p.y < 0 || p.y > 0.8f * p.x; });
  const MountDecision unsure = decided(few);
  ASSERT_GT(unsure.confidence, 0.1f);
  ASSERT_LT(unsure.confidence, 1);

  settings.limits.min_confidence = unsure.confidence + 0.01f;
  EXPECT_FALSE(decided(few, settings).accepted());
  settings.limits.min_confidence = unsure.confidence - 0.01f;
  EXPECT_TRUE(decided(few, settings).accepted());
}

TEST(MountSentence, ReportsHeightTiltAndConfidenceOfAnAcceptedEstimate) {
  const tests::YardScan scan = tests::scan_of({.mounting = {.height = 1.73, .pitch = 20}});

  const std::string sentence =
      to_sentence(MountEstimator({.tilt = TiltSource::estimate}).estimate(scan.view()));

  EXPECT_THAT(sentence, testing::MatchesRegex("sensor 1\\.7[0-9] m above the ground, tilted by "
                                              "[12][0-9]\\.[0-9] degrees, up is \\(-0\\.3.*\\), "
                                              "confidence 1\\.00"));
}

TEST(MountSentence, ReportsTheConfiguredHeight) {
  EXPECT_EQ(to_sentence(MountDecision{}), "sensor 1.73 m above the ground, as configured");
}

}  // namespace
}  // namespace flagstone
