// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/scan.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr std::array<std::uint64_t, 3> seeds{1, 2, 3};
constexpr std::size_t no_beam = 1'000;

Vector3 point_of(const SimulatedScan& scan, std::size_t i) {
  return {scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]};
}

SemanticClass class_of(const SimulatedScan& scan, std::size_t i) {
  return static_cast<SemanticClass>(scan.classes[i]);
}

// A street and a sensor in it.
struct Drive {
  explicit Drive(std::uint64_t seed)
      : scene(make_street(seed)), pose(sensor_pose(scene.ground(), sensor, 0, -1.6, 0)) {}

  [[nodiscard]] SimulatedScan scan(const Noise& noise, std::uint64_t seed = 1,
                                   unsigned threads = 1) const {
    return simulate(scene, sensor, noise, pose, seed, {.threads = threads});
  }
  // Height of a point of the scan above the ground below it, metres.
  [[nodiscard]] double above_ground(Vector3 point) const {
    const Vector3 world = pose.to_world(point);
    return world.z - scene.ground().height(world.x, world.y);
  }

  Sensor sensor = Sensor::named("hdl-64e");
  Scene scene;
  Frame pose;
};

// The beam of the sensor in the direction of this point, or no_beam.
std::size_t beam_of(const Sensor& sensor, Vector3 point) {
  const double elevation = std::atan2(point.z, std::hypot(point.x, point.y)) / radians;
  for (std::size_t beam = 0; beam < sensor.elevations.size(); ++beam) {
    if (std::abs(elevation - sensor.elevations[beam]) < 1e-4) return beam;
  }
  return no_beam;
}

// Degrees to the left of straight ahead; a value rounded to just below 360 counts as 0.
double azimuth_of(Vector3 point) {
  const double azimuth = std::atan2(point.y, point.x) / radians;
  return azimuth < -1e-4 ? azimuth + 360 : azimuth;
}

TEST(Scan, GroundPointsWithoutNoiseAreOnTheGround) {
  const Drive drive(3);
  const SimulatedScan scan = drive.scan(no_noise());
  std::size_t ground_points = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!is_ground(class_of(scan, i))) continue;
    ++ground_points;
    ASSERT_NEAR(drive.above_ground(point_of(scan, i)), 0, 0.001) << "point " << i;
  }
  EXPECT_GT(ground_points, 30'000U);
}

TEST(Scan, GroundPointsHaveTheClassOfTheGroundAtTheirPosition) {
  const Drive drive(1);
  const SimulatedScan scan = drive.scan(no_noise());
  std::size_t ground_points = 0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!is_ground(class_of(scan, i))) continue;
    const Vector3 world = drive.pose.to_world(point_of(scan, i));
    ++ground_points;
    different += drive.scene.ground().surface(world.x, world.y).semantic != class_of(scan, i);
  }

  // Rounding may move a point over the border between two surfaces.
  EXPECT_LT(different, ground_points / 1'000);
}

TEST(Scan, OtherPointsWithoutNoiseAreNotBelowTheGround) {
  const Drive drive(2);
  const SimulatedScan scan = drive.scan(no_noise());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_GT(drive.above_ground(point_of(scan, i)), -0.001) << "point " << i;
  }
}

TEST(Scan, GhostPointsAreBelowTheGround) {
  const Drive drive(3);
  const SimulatedScan scan = drive.scan(Noise{}, 3);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (class_of(scan, i) != SemanticClass::outlier) continue;
    EXPECT_LT(drive.above_ground(point_of(scan, i)), 0) << "point " << i;
  }
}

TEST(Scan, HasAFewDozenGhostPointsMostlyWithinTenMetres) {
  constexpr double near = 10;
  std::size_t all = 0;
  std::size_t within = 0;
  for (const std::uint64_t seed : seeds) {
    const SimulatedScan scan = simulate_street(seed);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (class_of(scan, i) != SemanticClass::outlier) continue;
      const Vector3 point = point_of(scan, i);
      ++all;
      within += std::hypot(point.x, point.y) < near;
    }
  }

  EXPECT_GT(all, 12 * seeds.size());
  EXPECT_LT(all, 100 * seeds.size());
  EXPECT_GT(2 * within, all);
}

TEST(Scan, HasNoGhostPointsWithoutNoise) {
  const SimulatedScan scan = Drive(1).scan(no_noise());

  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_NE(class_of(scan, i), SemanticClass::outlier);
  }
}

TEST(Scan, PointsAreOnTheBeamsOfTheSensorInFiringOrder) {
  const Drive drive(1);
  const SimulatedScan scan = drive.scan(Noise{});
  const double step = 360.0 / drive.sensor.firings;
  std::size_t beam_before = 0;
  double azimuth_before = -1;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3 point = point_of(scan, i);
    const std::size_t beam = beam_of(drive.sensor, point);
    const double azimuth = azimuth_of(point);
    ASSERT_NE(beam, no_beam) << "point " << i;
    ASSERT_NEAR(azimuth / step, std::round(azimuth / step), 1e-3) << "point " << i;
    ASSERT_TRUE(beam > beam_before || (beam == beam_before && azimuth > azimuth_before))
        << "point " << i;
    beam_before = beam;
    azimuth_before = azimuth;
  }
  EXPECT_EQ(beam_before, drive.sensor.elevations.size() - 1);
}

TEST(Scan, PointsAreWithinTheRangeOfTheSensor) {
  constexpr double rounding = 1e-4;
  const SimulatedScan scan = simulate_street(2);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = length(point_of(scan, i));
    ASSERT_GE(range, Sensor::named("hdl-64e").min_range - rounding);
    ASSERT_LE(range, Sensor::named("hdl-64e").max_range + rounding);
  }
}

TEST(Scan, HasNoPointsBeyondAShorterRange) {
  Drive drive(1);
  drive.sensor.max_range = 10;
  const SimulatedScan scan = drive.scan(Noise{});

  ASSERT_GT(scan.size(), 1'000U);
  for (std::size_t i = 0; i < scan.size(); ++i) ASSERT_LE(length(point_of(scan, i)), 10 + 1e-4);
}

TEST(Scan, IntensitiesAreBetweenZeroAndOne) {
  const SimulatedScan scan = simulate_street(1);

  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_GE(scan.xyzi[4 * i + 3], 0);
    ASSERT_LE(scan.xyzi[4 * i + 3], 1);
  }
}

TEST(Scan, MarkingsAreBrighterThanTheRoad) {
  const SimulatedScan scan = simulate_street(1);
  const auto mean_intensity = [&](SemanticClass semantic) {
    double sum = 0;
    double count = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (class_of(scan, i) != semantic) continue;
      sum += static_cast<double>(scan.xyzi[4 * i + 3]);
      ++count;
    }
    return sum / count;
  };

  EXPECT_GT(mean_intensity(SemanticClass::lane_marking), 1.5 * mean_intensity(SemanticClass::road));
}

TEST(Scan, IsBitIdenticalOnEveryRunAndNumberOfThreads) {
  const Drive drive(4);
  const SimulatedScan one = drive.scan(Noise{}, 7, 1);
  for (const unsigned threads : {0U, 1U, 2U, 3U, 7U}) {
    const SimulatedScan again = drive.scan(Noise{}, 7, threads);
    EXPECT_EQ(again.xyzi, one.xyzi) << threads << " threads";
    EXPECT_EQ(again.classes, one.classes) << threads << " threads";
  }
}

TEST(Scan, IsTheSameWhenTheStreetIsBuiltAgain) {
  const SimulatedScan one = simulate_street(5);
  const SimulatedScan again = simulate_street(5, 2);

  EXPECT_EQ(again.xyzi, one.xyzi);
  EXPECT_EQ(again.classes, one.classes);
}

TEST(Scan, DiffersFromSeedToSeed) {
  EXPECT_NE(simulate_street(1).xyzi, simulate_street(2).xyzi) << "streets";
  const Drive drive(1);
  EXPECT_NE(drive.scan(Noise{}, 1).xyzi, drive.scan(Noise{}, 2).xyzi) << "noise on one street";
}

TEST(Scan, ContainsEveryClassOfAStreet) {
  std::set<SemanticClass> seen;
  for (const std::uint64_t seed : seeds) {
    const SimulatedScan scan = simulate_street(seed);
    for (std::size_t i = 0; i < scan.size(); ++i) seen.insert(class_of(scan, i));
  }

  using enum SemanticClass;
  const std::set<SemanticClass> all{outlier,    car,          person,   road,  parking,
                                    sidewalk,   other_ground, building, fence, lane_marking,
                                    vegetation, trunk,        terrain,  pole,  traffic_sign};
  EXPECT_EQ(seen, all);
}

TEST(Scan, ResemblesARealStreet) {
  for (const std::uint64_t seed : seeds) {
    const SimulatedScan scan = simulate_street(seed);
    std::size_t ground = 0;
    std::size_t near_ground = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!is_ground(class_of(scan, i))) continue;
      const Vector3 point = point_of(scan, i);
      ++ground;
      near_ground += std::hypot(point.x, point.y) < 20;
    }
    const auto share = static_cast<double>(ground) / static_cast<double>(scan.size());

    EXPECT_GT(scan.size(), 110'000U);
    EXPECT_LT(scan.size(), 130'000U);
    EXPECT_GT(share, 0.35);
    EXPECT_LT(share, 0.7);
    EXPECT_GT(static_cast<double>(near_ground), 0.8 * static_cast<double>(ground));
  }
}

TEST(Scan, SensorIsAtItsHeightAboveTheRoad) {
  for (const std::uint64_t seed : seeds) {
    Random random = Random::stream(seed, 0);
    const Ground ground = make_ground(plan_street(random).shape);
    const Sensor sensor = Sensor::named("hdl-64e");
    const Frame pose = sensor_pose(ground, sensor, 0, -1.6, 0);

    const Vector3 below = pose.origin - sensor.height * pose.up;

    EXPECT_NEAR(below.z, ground.height(below.x, below.y), 0.001);
    EXPECT_EQ(ground.surface(below.x, below.y).semantic, SemanticClass::road);
  }
}

TEST(Scan, BeamsPassUnderACar) {
  const Drive drive(1);
  const SimulatedScan scan = drive.scan(no_noise());
  std::size_t beneath = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!is_ground(class_of(scan, i))) continue;
    const Vector3 world = drive.pose.to_world(point_of(scan, i));
    const auto above = drive.scene.caster().cast(world, {0, 0, 1}, 0.05, 1);
    if (!above) continue;
    const Surface& surface = drive.scene.caster().mesh().surface(above->triangle);
    beneath += surface.semantic == SemanticClass::car;
  }

  EXPECT_GT(beneath, 30U);
}

}  // namespace
}  // namespace flagstone::sim
