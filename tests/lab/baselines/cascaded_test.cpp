// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/cascaded.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/baselines/cascaded_beams.hpp"
#include "lab/baselines/cascaded_planes.hpp"
#include "numbers.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using baselines::Beams;
using baselines::ContinuousPlanes;
using baselines::Coordinates;

constexpr double sensor_height = 1.73;

double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

/// The scene of a ray-cast scan: a plane that rises forward, and a wall across it.
struct Scene {
  double slope = 0;        ///< of the ground along x, degrees; level below the sensor
  double wall_x = inf;     ///< metres
  double wall_height = 3;  ///< above the ground at its base, metres
  double max_range = 60;   ///< metres
};

struct Scan {
  std::vector<Point> points;
  std::vector<std::uint16_t> rings;
  std::vector<bool> on_wall;

  [[nodiscard]] CloudView view() const { return CloudView(std::span(points)); }
};

/// Horizontal distance to the ground along a ray, given the tangent of its elevation and the cosine
/// of its azimuth.
double distance_to_ground(const Scene& scene, double rise, double cosine) {
  const double closing = tangent(scene.slope) * cosine - rise;
  return closing > 0 ? sensor_height / closing : inf;
}

/// A noise-free scan of an HDL-64E, every half degree.
Scan scan_of(const Scene& scene) {
  Scan scan;
  const std::vector<float> elevations = CascadedConfig::hdl_64e_elevations();
  for (std::size_t ring = 0; ring < elevations.size(); ++ring) {
    for (int step = 0; step < 720; ++step) {
      const double azimuth = (step + 0.5) * std::numbers::pi / 360;
      const double cosine = std::cos(azimuth);
      const double rise = tangent(elevations[ring]);
      const double ground = distance_to_ground(scene, rise, cosine);
      const double wall = cosine > 0 ? scene.wall_x / cosine : inf;
      const double top = -sensor_height + tangent(scene.slope) * scene.wall_x + scene.wall_height;
      const bool on_wall = wall < ground && wall * rise < top;
      const double range = on_wall ? wall : ground;
      if (range > scene.max_range) continue;
      scan.points.push_back({static_cast<float>(range * cosine),
                             static_cast<float>(range * std::sin(azimuth)),
                             static_cast<float>(range * rise)});
      scan.rings.push_back(static_cast<std::uint16_t>(ring));
      scan.on_wall.push_back(on_wall);
    }
  }
  return scan;
}

std::vector<Label> labels_of(const Scan& scan, const CascadedConfig& config = {}) {
  Cascaded cascaded(config);
  Segmentation result;
  EXPECT_TRUE(cascaded.segment(scan.view(), result).ok());
  return {result.labels().begin(), result.labels().end()};
}

std::vector<Label> labels_by_rings(const Scan& scan, const CascadedConfig& config = {}) {
  Cascaded cascaded(config);
  Segmentation result;
  EXPECT_TRUE(cascaded.segment(scan.view(), scan.rings, result).ok());
  return {result.labels().begin(), result.labels().end()};
}

/// Fraction of the points on the wall, or of the other points, labelled ground, 0 to 1.
double ground_fraction(const Scan& scan, const std::vector<Label>& labels, bool on_wall) {
  double count = 0;
  double ground = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (scan.on_wall[i] != on_wall) continue;
    ++count;
    ground += labels[i] == Label::ground ? 1 : 0;
  }
  return ground / count;
}

/// Points every 0.5 m for x from 6 to 10 and y from -3 to 3, on a plane that rises by `slope`
/// degrees along x and is `height` above the ground at x = 6.
struct Slab {
  std::vector<float> x, y, z;

  Slab(double slope, double height) {
    for (double px = 6; px < 10; px += 0.5) {
      for (double py = -3; py < 3; py += 0.5) {
        x.push_back(static_cast<float>(px));
        y.push_back(static_cast<float>(py));
        z.push_back(static_cast<float>(-sensor_height + height + tangent(slope) * (px - 6)));
      }
    }
  }
  [[nodiscard]] Coordinates coordinates() const { return {x, y, z}; }
};

/// The plane found for the slab after a level region, if the two meet at x = 6.
Plane plane_of(const Slab& slab, const CascadedConfig& config = {}) {
  const ContinuousPlanes planes(config);
  return planes.fit(slab.coordinates(), planes.below_sensor(), 6, 0, 0);
}

TEST(Cascaded, FlatGroundIsGround) {
  EXPECT_THAT(labels_of(scan_of({})), testing::Each(Label::ground));
}

TEST(Cascaded, KeepsASlopeThatAFlatGroundThresholdLoses) {
  const Scan scan = scan_of({.slope = 4});
  CascadedConfig flat_ground;
  flat_ground.max_slope = 0;

  EXPECT_GT(ground_fraction(scan, labels_of(scan), false), 0.999);
  EXPECT_LT(ground_fraction(scan, labels_of(scan, flat_ground), false), 0.7);
}

TEST(Cascaded, RemovesAWallThatBringsRingsCloserTogether) {
  const Scan scan = scan_of({.wall_x = 15});
  CascadedConfig without_filter;
  without_filter.min_object_height = 100;

  EXPECT_EQ(ground_fraction(scan, labels_of(scan), true), 0);
  EXPECT_GT(ground_fraction(scan, labels_of(scan), false), 0.95);
  EXPECT_GT(ground_fraction(scan, labels_of(scan, without_filter), true), 0.05);  // its base
}

TEST(Cascaded, KeepsObjectsBelowTheMinimumHeight) {
  const Scan scan = scan_of({.wall_x = 15, .wall_height = 0.07});

  EXPECT_THAT(labels_of(scan), testing::Each(Label::ground));
}

TEST(Cascaded, InfersTheRingsOfTheSensorFromElevations) {
  const Scan scan = scan_of({.slope = 3, .wall_x = 20});
  const Beams beams{CascadedConfig{}};

  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const Point& p = scan.points[i];
    ASSERT_EQ(beams.nearest(std::hypot(p.x, p.y), p.z), scan.rings[i]);
  }
  EXPECT_EQ(labels_of(scan), labels_by_rings(scan));
}

TEST(Cascaded, InferredRingsDifferByAtMostOneFromTheRingsOfAnHdl32e) {
  const auto scans = tests::real_scans("nuscenes");
  FLAGSTONE_REQUIRE_SCANS(scans);
  CascadedConfig hdl_32e;
  hdl_32e.beam_elevations.clear();
  for (int i = 0; i < 32; ++i) {
    hdl_32e.beam_elevations.push_back(static_cast<float>(-92.0 / 3 + i * 4.0 / 3));
  }
  const Beams beams(hdl_32e);
  io::Cloud cloud;
  ASSERT_TRUE(io::read_cloud(scans[0].points, {}, cloud).ok());
  const io::Field* ring = cloud.find("ring");
  ASSERT_NE(ring, nullptr);

  std::size_t same = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud.view()[i];
    const float range = std::hypot(p.x, p.y);
    if (range < 3) continue;  // the ego vehicle
    const int inferred = beams.nearest(range, p.z);
    const int recorded = static_cast<int>(cloud.value(i, *ring));
    ASSERT_LE(std::abs(inferred - recorded), 1);
    same += inferred == recorded ? 1U : 0U;
    ++count;
  }
  EXPECT_GT(same, count * 9 / 10);
}

TEST(Cascaded, APointBelowOrAboveAllBeamsBelongsToTheNearest) {
  const Beams beams{CascadedConfig{}};

  EXPECT_EQ(beams.nearest(1, -5), 0);
  EXPECT_EQ(beams.nearest(0, -5), 0);
  EXPECT_EQ(beams.nearest(1, 5), 63);
}

TEST(Cascaded, UsesTheGivenRings) {
  Scan scan = scan_of({.wall_x = 15});
  std::ranges::fill(scan.rings,
                    std::uint16_t{0});  // all points on one ring, so no rings are close together

  EXPECT_GT(ground_fraction(scan, labels_by_rings(scan), true), 0.05);
}

TEST(Cascaded, RejectsRingsThatDoNotFit) {
  Scan scan = scan_of({});
  Cascaded cascaded;
  Segmentation result;
  const std::span<const std::uint16_t> rings = scan.rings;

  const Status too_few = cascaded.segment(scan.view(), rings.first(10), result);
  scan.rings[100] = 64;
  const Status no_such_beam = cascaded.segment(scan.view(), rings, result);

  EXPECT_EQ(too_few.code(), StatusCode::invalid_argument);
  EXPECT_EQ(no_such_beam.code(), StatusCode::invalid_argument);
  EXPECT_TRUE(result.labels().empty());
}

TEST(Cascaded, RingsOnASlopeAreCloserTogetherThanOnFlatGround) {
  CascadedConfig config;
  config.beam_elevations = {-20, -10, 3, 7};
  config.max_slope = 5;
  const Beams beams(config);

  EXPECT_NEAR(
      beams.least_distance(0, 1),
      sensor_height / (tangent(10) + tangent(5)) - sensor_height / (tangent(20) + tangent(5)),
      1e-5);
  EXPECT_NEAR(beams.flat_radius(1), sensor_height / tangent(10), 1e-5);
  EXPECT_LT(beams.least_distance(0, 1), beams.flat_radius(1) - beams.flat_radius(0));
  EXPECT_LT(beams.least_distance(1, 2), inf);  // beam 2 hits ground steeper than 3 degrees
  EXPECT_EQ(beams.least_distance(2, 3), inf);
}

TEST(Cascaded, ReplacesAPlaneTiltedTooMuchByThePreviousPlane) {
  CascadedConfig loose;
  loose.max_angle_change = 30;

  EXPECT_EQ(plane_of(Slab(20, 0)).normal[2], 1);
  EXPECT_NEAR(plane_of(Slab(20, 0), loose).normal[2], std::cos(20 * std::numbers::pi / 180), 1e-6);
  EXPECT_NEAR(plane_of(Slab(10, 0)).normal[2], std::cos(10 * std::numbers::pi / 180), 1e-6);
}

TEST(Cascaded, ReplacesAPlaneWithTooLargeAStepByThePreviousPlane) {
  CascadedConfig loose;
  loose.max_height_change = 1;

  EXPECT_NEAR(plane_of(Slab(0, 0.8)).d, sensor_height, 1e-6);
  EXPECT_NEAR(plane_of(Slab(0, 0.8), loose).d, sensor_height - 0.8, 1e-5);
  EXPECT_NEAR(plane_of(Slab(0, 0.3)).d, sensor_height - 0.3, 1e-5);
}

TEST(Cascaded, ARegionWithFewPointsUsesThePreviousPlane) {
  Scan scan = scan_of({.max_range = 9});
  scan.points.push_back({50, 1, -1.7f});
  scan.points.push_back({50, 2, 1.0f});

  const std::vector<Label> labels = labels_of(scan);

  EXPECT_EQ(labels[labels.size() - 2], Label::ground);
  EXPECT_EQ(labels.back(), Label::nonground);
}

TEST(Cascaded, ReturnsRegionsAsPatches) {
  Cascaded cascaded;
  Segmentation result;
  ASSERT_TRUE(cascaded.segment(scan_of({.slope = 2}).view(), result).ok());

  ASSERT_EQ(result.patches().size(), 16u);
  for (const Patch& patch : result.patches()) {
    EXPECT_TRUE(patch.is_ground());
    EXPECT_NEAR(patch.normal[0], -std::sin(2 * std::numbers::pi / 180), 0.002);
    EXPECT_NEAR(patch.normal[2], std::cos(2 * std::numbers::pi / 180), 0.002);
  }
}

TEST(Cascaded, PointsBeyondMaxRangeAreOutOfRange) {
  const Scan scan{.points = {{121, 0, -1.7f}, {0, -119, -1.7f}}, .rings = {}, .on_wall = {}};

  EXPECT_EQ(labels_of(scan), (std::vector{Label::out_of_range, Label::ground}));
}

TEST(Cascaded, TheHdl64eHas64BeamsLowestFirst) {
  const std::vector<float> elevations = CascadedConfig::hdl_64e_elevations();

  ASSERT_EQ(elevations.size(), 64u);
  EXPECT_TRUE(std::ranges::is_sorted(elevations));
  EXPECT_NEAR(elevations.front(), -24.33f, 0.01f);
  EXPECT_NEAR(elevations[31], -8.83f, 0.01f);
  EXPECT_NEAR(elevations[32], -8.33f, 0.01f);
  EXPECT_EQ(elevations.back(), 2);
}

TEST(Cascaded, RejectsBeamsThatDoNotAscend) {
  CascadedConfig highest_first;
  std::ranges::reverse(highest_first.beam_elevations);
  CascadedConfig one_beam;
  one_beam.beam_elevations = {-10};

  EXPECT_THROW(Cascaded{highest_first}, std::invalid_argument);
  EXPECT_THROW(Cascaded{one_beam}, std::invalid_argument);
}

}  // namespace
}  // namespace flagstone
