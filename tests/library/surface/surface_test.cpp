// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Properties of the complete method `surface`, on ground of known shape.
#include "flagstone/surface.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "lab/sim/drive.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"
#include "random_surface.hpp"

namespace flagstone {
namespace {

using tests::Ground;
using tests::Outcome;
using tests::view_of;

constexpr float height_of_sensor = 1.73f;

float level(float, float) { return -height_of_sensor; }

/// A scan of ground only: rings of points from 3 to 80 m with increasing distances. Each point has
/// a random offset, so that two scans differ in their positions.
std::vector<Point> scan_of(const Ground& ground, int points_per_ring = 1800,
                           std::uint32_t seed = 1) {
  std::mt19937 random(seed);
  const auto unit = [&] { return static_cast<float>(random() >> 8U) / 16777216.0f; };
  std::vector<Point> cloud;
  for (float range = 3; range < 80; range *= 1.05f) {
    for (int i = 0; i < points_per_ring; ++i) {
      const float angle = 2 * std::numbers::pi_v<float> * (static_cast<float>(i) + unit()) /
                          static_cast<float>(points_per_ring);
      const float rho = range * (1 + 0.01f * unit());
      const float x = rho * std::cos(angle);
      const float y = rho * std::sin(angle);
      cloud.push_back({x, y, ground(x, y)});
    }
  }
  return cloud;
}

/// A plane below the sensor with slope angle `tilt` in `direction`, both in degrees.
Ground tilted(float tilt, float direction) {
  const float slope = std::tan(tilt * std::numbers::pi_v<float> / 180);
  const float angle = direction * std::numbers::pi_v<float> / 180;
  return [=](float x, float y) {
    return -height_of_sensor + slope * (std::cos(angle) * x + std::sin(angle) * y);
  };
}

Outcome segmented(const std::vector<Point>& cloud, const SurfaceConfig& config = {}) {
  return tests::segmented(config, view_of(cloud));
}

/// Fraction of points with different labels.
double fraction_of_different(const std::vector<Label>& a, const std::vector<Label>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += a[i] != b[i] ? 1U : 0U;
  return static_cast<double>(different) / static_cast<double>(a.size());
}

std::size_t ground_count(const Outcome& outcome) {
  return static_cast<std::size_t>(std::ranges::count(outcome.labels, Label::ground));
}

/// Two simulated streets with cars, houses, people and trees.
const std::vector<std::vector<Point>>& streets() {
  static const std::vector<std::vector<Point>> made = [] {
    std::vector<std::vector<Point>> clouds;
    for (const std::uint64_t seed : {1U, 2U}) {
      const sim::SimulatedScan scan = sim::simulate_street(seed, 2);
      std::vector<Point>& cloud = clouds.emplace_back();
      for (std::size_t i = 0; i < scan.size(); ++i) {
        cloud.push_back({scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]});
      }
    }
    return clouds;
  }();
  return made;
}

/// The cloud rotated by 90 degrees, x to y.
std::vector<Point> rotated(std::vector<Point> cloud) {
  for (Point& p : cloud) p = {-p.y, p.x, p.z};
  return cloud;
}

std::vector<Point> every(std::size_t step, const std::vector<Point>& cloud) {
  std::vector<Point> some;
  for (std::size_t i = 0; i < cloud.size(); i += step) some.push_back(cloud[i]);
  return some;
}

TEST(SurfaceMethod, LevelGroundIsGroundAtHeightZeroWithinAMillimetre) {
  const std::vector<Point> cloud = scan_of(level);

  const Outcome outcome = segmented(cloud);

  EXPECT_EQ(ground_count(outcome), cloud.size());
  EXPECT_THAT(outcome.heights, testing::Each(testing::FloatNear(0, 0.001f)));
}

constexpr std::array<float, 4> directions = {0, 40, 90, 200};

TEST(SurfaceMethod, ATiltedPlaneIsGround) {
  for (const float tilt : {2.0f, 4.0f, 6.0f}) {
    for (const float direction : directions) {
      const std::vector<Point> cloud = scan_of(tilted(tilt, direction));

      EXPECT_EQ(ground_count(segmented(cloud)), cloud.size()) << tilt << " to " << direction;
    }
  }
}

TEST(SurfaceMethod, ASteepPlaneLosesAlmostNoPoints) {
  // 19 degrees are a slope of 0.34; max_slope is 0.35.
  for (const float tilt : {10.0f, 15.0f, 19.0f}) {
    for (const float direction : directions) {
      const std::vector<Point> cloud = scan_of(tilted(tilt, direction));

      EXPECT_GE(static_cast<double>(ground_count(segmented(cloud))),
                0.998 * static_cast<double>(cloud.size()))
          << tilt << " to " << direction;
    }
  }
}

TEST(SurfaceMethod, HeightsOnATiltedPlaneAreZeroWithinFiveMillimetres) {
  for (const float tilt : {3.0f, 6.0f, 10.0f}) {
    for (const float direction : directions) {
      const std::vector<Point> cloud = scan_of(tilted(tilt, direction));

      const Outcome outcome = segmented(cloud);

      for (std::size_t i = 0; i < cloud.size(); ++i) {
        const float range = std::hypot(cloud[i].x, cloud[i].y);
        ASSERT_LT(std::abs(outcome.heights[i]), 0.005f)
            << tilt << " degrees to " << direction << ", at " << range << " m";
      }
    }
  }
}

TEST(SurfaceMethod, ABoxOnAPlaneIsNotGroundAndHasItsTrueHeight) {
  const Ground ground = tilted(4, 30);
  const auto is_inside = [](float x, float y) { return x > 9 && x < 12 && y > 1 && y < 5; };
  std::vector<Point> cloud =
      scan_of([&](float x, float y) { return ground(x, y) + (is_inside(x, y) ? 1.5f : 0.0f); });
  for (float up = 0.1f; up < 1.5f; up += 0.05f) {  // the side that faces the sensor
    for (float y = 1; y < 5; y += 0.02f) cloud.push_back({9, y, ground(9, y) + up});
  }

  const Outcome outcome = segmented(cloud);

  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud[i];
    const float height = p.z - ground(p.x, p.y);
    if (height > 0.05f) {
      ASSERT_EQ(outcome.labels[i], Label::nonground) << p.x << ", " << p.y << ", " << height;
      ASSERT_NEAR(outcome.heights[i], height, 0.02f) << p.x << ", " << p.y;
    } else {
      ASSERT_EQ(outcome.labels[i], Label::ground) << p.x << ", " << p.y;
    }
  }
}

TEST(SurfaceMethod, PointsFarBelowGroundAreNoiseAndChangeNothingElse) {
  std::vector<Point> cloud = scan_of(level);
  std::vector<std::size_t> ghosts;
  for (std::size_t i = 50; i < cloud.size(); i += 500) {
    cloud[i].z -= 1.1f + 0.06f * std::hypot(cloud[i].x, cloud[i].y);
    ghosts.push_back(i);
  }

  const Outcome outcome = segmented(cloud);

  for (const std::size_t i : ghosts) ASSERT_EQ(outcome.labels[i], Label::noise) << i;
  EXPECT_EQ(ground_count(outcome), cloud.size() - ghosts.size());
}

TEST(SurfaceMethod, AKerbStaysSharp) {
  // A pavement along x, 12 cm above the road.
  const std::vector<Point> cloud =
      scan_of([](float, float y) { return -height_of_sensor + (y > 4.25f ? 0.12f : 0.0f); });
  Surface segmenter;
  Segmentation result;

  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  EXPECT_EQ(result.count(Label::ground), cloud.size());
  for (float x = -5; x <= 5; x += 0.5f) {
    EXPECT_NEAR(result.surface().height(x, 3.75f), -height_of_sensor, 0.02f) << x;
    EXPECT_NEAR(result.surface().height(x, 4.75f), -height_of_sensor + 0.12f, 0.02f) << x;
  }
}

// The first patches are accepted by their height above the expected ground.
TEST(SurfaceMethod, AnErrorOf30CentimetresInSensorHeightChangesAtMostOneLabelIn1000) {
  for (const std::vector<Point>& cloud : streets()) {
    const Outcome right = segmented(cloud);
    for (const float error : {-0.3f, -0.1f, 0.1f, 0.3f}) {
      SurfaceConfig config;
      config.sensor_height += error;

      const Outcome wrong = segmented(cloud, config);

      EXPECT_LE(fraction_of_different(right.labels, wrong.labels), 1e-3) << error;
      double different = 0;
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (std::isnan(right.heights[i])) continue;
        const float difference = std::abs(right.heights[i] - wrong.heights[i]);
        // Nothing is measured below the sensor, so the ground height there follows from the sensor
        // height.
        if (std::hypot(cloud[i].x, cloud[i].y) < 4) {
          ASSERT_LE(difference, 0.07f) << error;
        } else if (difference > 0.02f) {
          ++different;
        }
      }
      EXPECT_LE(different, 0.02 * static_cast<double>(cloud.size())) << error;
    }
  }
}

// Cells and patches are symmetric, so a scan rotated by 90 degrees should get the same labels.
// There are three exceptions: a cell includes only one of the two edges along each axis; a large
// patch is sampled by a hash of the positions of its points; patches at the same distance from the
// sensor are evaluated one after the other.
TEST(SurfaceMethod, RotatingAScanBy90DegreesRotatesTheResult) {
  for (const std::vector<Point>& dense : streets()) {
    for (const std::vector<Point>& cloud : {dense, every(20, dense)}) {
      EXPECT_LE(fraction_of_different(segmented(cloud).labels, segmented(rotated(cloud)).labels),
                0.006);
    }
  }
}

TEST(SurfaceMethod, APlaneRotatedBy90DegreesIsGround) {
  const std::vector<Point> cloud = scan_of(tilted(5, 30));

  EXPECT_EQ(ground_count(segmented(rotated(cloud))), cloud.size());
}

/// `count` indices in random order.
std::vector<std::size_t> shuffled_order(std::size_t count, std::uint32_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::shuffle(order, std::mt19937(seed));
  return order;
}

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::size_t>& order) {
  std::vector<T> ordered(values.size());
  std::ranges::transform(order, ordered.begin(), [&](std::size_t i) { return values[i]; });
  return ordered;
}

// permutation_test.cpp compares all results, byte by byte, for many clouds.
TEST(SurfaceMethod, TheOrderOfPointsHasNoInfluence) {
  for (const std::vector<Point>& cloud : streets()) {
    const Outcome ordered = segmented(cloud);
    const std::vector<std::size_t> order = shuffled_order(cloud.size(), 1);

    const Outcome shuffled = segmented(in_order(cloud, order));

    EXPECT_EQ(shuffled.labels, in_order(ordered.labels, order));
    for (std::size_t i = 0; i < order.size(); ++i) {
      const float height = ordered.heights[order[i]];
      ASSERT_EQ(std::bit_cast<std::uint32_t>(shuffled.heights[i]),
                std::bit_cast<std::uint32_t>(height));
    }
  }
}

TEST(SurfaceMethod, HeightsAreBitIdenticalToZMinusTheSurface) {
  for (const std::vector<Point>& cloud :
       {streets()[0], tests::corrupted_cloud(30000, 2), every(50, streets()[1])}) {
    Surface segmenter;
    Segmentation result;
    ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Point& p = cloud[i];
      const float height = result.heights()[i];
      const Label label = result.labels()[i];
      if (label == Label::invalid || label == Label::out_of_range) {
        ASSERT_TRUE(std::isnan(height));
        continue;
      }
      const float above = p.z - result.surface().height(p.x, p.y);
      ASSERT_EQ(std::isnan(height), std::isnan(above)) << p.x << ", " << p.y;
      if (!std::isnan(height)) {
        ASSERT_EQ(height, above) << p.x << ", " << p.y;
      }
    }
  }
}

}  // namespace
}  // namespace flagstone
