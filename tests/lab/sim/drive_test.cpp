// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/drive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/flat_scene.hpp"

namespace flagstone::sim {
namespace {

constexpr double radians = std::numbers::pi / 180;

TEST(Mounting, UprightSensorLooksAlongItsVehicle) {
  const Frame vehicle = upright_frame({1, 2, 3}, 0.5);

  const Frame pose = sensor_pose(vehicle, {.height = 2});

  EXPECT_EQ(length(pose.forward - vehicle.forward), 0);
  EXPECT_EQ(length(pose.up - vehicle.up), 0);
  EXPECT_NEAR(length(pose.origin - Vector3{1, 2, 5}), 0, 1e-12);
}

TEST(Mounting, PitchLooksDownAheadAndRollLowersTheRightSide) {
  const Frame pitched = sensor_pose(Frame{}, {.height = 1, .pitch = 20});
  const Frame rolled = sensor_pose(Frame{}, {.height = 1, .roll = 10});

  EXPECT_NEAR(pitched.forward.z, -std::sin(20 * radians), 1e-12);
  EXPECT_NEAR(pitched.left.z, 0, 1e-12);
  EXPECT_NEAR(rolled.left.z, std::sin(10 * radians), 1e-12);
  EXPECT_NEAR(rolled.forward.z, 0, 1e-12);
}

TEST(Mounting, AxesStayAtRightAngles) {
  const Frame pose = sensor_pose(Frame{}, {.height = 1, .pitch = 25, .roll = -15});

  EXPECT_NEAR(length(cross(pose.forward, pose.left) - pose.up), 0, 1e-12);
  EXPECT_NEAR(pose.up.z, std::cos(25 * radians) * std::cos(15 * radians), 1e-12);
}

TEST(Mounting, HeightsAreMeasuredInTheVehicleFrameForAnyTilt) {
  const Sensor& sensor = Sensor::named("os0-128");
  const Drive drive(*find_scene_kind("flat_street"), sensor,
                    {.height = 1.2, .pitch = 20, .roll = -10}, 1);
  const Drive upright(*find_scene_kind("flat_street"), sensor, {.height = 1.2}, 1);
  const Scene scene = drive.scene();
  const SimulatedScan scan = drive.scan(scene, no_noise(), 0);

  const std::vector<float> ground = drive.ground_of(scan, 0);

  ASSERT_EQ(ground.size(), scan.size());
  const Frame& leaning = drive.poses()[0];
  const Frame& vehicle = upright.poses()[0];
  double farthest = 0;
  for (std::size_t i = 0; i < scan.size(); i += 7) {
    const Vector3 point = point_of(scan, i);
    const double height = point.z - static_cast<double>(ground[i]);
    const Vector3 foot = leaning.to_world(point) - height * vehicle.up;
    farthest = std::max(farthest, std::abs(foot.z - scene.ground().height(foot.x, foot.y)));
  }
  EXPECT_LT(farthest, 0.001);
}

TEST(Pace, CountsTheScansOfOneScene) {
  EXPECT_EQ(Pace{}.frames(), std::size_t{frames_per_drive});
  EXPECT_EQ((Pace{.rate = 10}.frames()), 91U);
  EXPECT_EQ((Pace{.rate = 10, .speed = 0.1}.frames()), 7201U);
  EXPECT_EQ((Pace{.rate = 20, .speed = 30}.frames()), 49U);
  EXPECT_EQ((Pace{.rate = 0.1, .speed = 30}.frames()), 1U);
}

TEST(Pace, FasterScansPassTheStopsOfTheDefaultPace) {
  const SceneKind& kind = *find_scene_kind("urban_street");
  const Sensor& sensor = Sensor::named("vlp-16");
  const Drive stops(kind, sensor, 3);
  const Drive drive(kind, sensor, {.height = sensor.height}, 3, {.rate = 10});

  ASSERT_EQ(drive.poses().size(), 91U);
  for (std::size_t stop = 0; stop < stops.poses().size(); ++stop) {
    EXPECT_EQ(drive.poses()[10 * stop].origin, stops.poses()[stop].origin);
    EXPECT_EQ(drive.poses()[10 * stop].forward, stops.poses()[stop].forward);
  }
}

TEST(Pace, PosesBetweenStopsAreSmooth) {
  const Sensor& sensor = Sensor::named("vlp-16");
  for (const char* scene : {"urban_street", "forest_track", "highway"}) {
    const Drive drive(*find_scene_kind(scene), sensor, {.height = sensor.height}, 1, {.rate = 10});
    const std::vector<Frame>& poses = drive.poses();
    for (std::size_t i = 1; i < poses.size(); ++i) {
      const Vector3 motion = poses[i].origin - poses[i - 1].origin;
      EXPECT_NEAR(length(motion), 0.8, 0.2) << scene << ", scan " << i;
      // A vehicle moves in the direction of its heading.
      EXPECT_GT(dot(motion, poses[i].forward), 0.99 * length(motion)) << scene << ", scan " << i;
    }
  }
}

constexpr Surface house{.semantic = SemanticClass::building, .reflectivity = 0.5F};
constexpr Surface lorry{.semantic = SemanticClass::car, .reflectivity = 0.5F};
constexpr double first_gap = 6;  // metres to the lorry at stop 0
constexpr double step = 3;       // motion of the lorry per second, metres

// The vehicle stands still, 20 m in front of a house, and a lorry moves away from it.
Landscape lorry_before_a_house(std::uint64_t /*seed*/) {
  Landscape landscape{.ground = flat_ground(),
                      .route = std::vector<Stop>(frames_per_drive),
                      .furnish =
                          [](const Ground&, const Stretch&) {
                            Mesh mesh;
                            add_wall(mesh, 20, house);
                            return mesh;
                          },
                      .moving =
                          [](const Ground&, double seconds) {
                            Mesh mesh;
                            add_wall(mesh, first_gap + step * seconds, lorry);
                            return mesh;
                          }};
  return landscape;
}

SimulatedScan scan_at(int stop, const Noise& noise = no_noise()) {
  const SceneKind kind{"lorry", "", lorry_before_a_house};
  const Drive drive(kind, sensor_ahead(10, 50), 1);
  const Scene scene = drive.scene();
  return drive.scan(scene, noise, stop);
}

TEST(Moving, ObjectsAreHitAtTheirPositionAtTheStop) {
  for (const int stop : {0, 1, 4}) {
    const SimulatedScan scan = scan_at(stop);
    ASSERT_EQ(scan.size(), 500U);
    for (std::size_t i = 0; i < scan.size(); ++i) {
      ASSERT_EQ(class_of(scan, i), SemanticClass::car);
      ASSERT_NEAR(point_of(scan, i).x, first_gap + step * stop, 1e-4);
    }
  }
}

TEST(Moving, ObjectsAreWhereTheyAreBetweenTwoStops) {
  const SceneKind kind{"lorry", "", lorry_before_a_house};
  const Drive drive(kind, sensor_ahead(10, 50), {}, 1, {.rate = 10});
  const Scene scene = drive.scene();

  const SimulatedScan scan = drive.scan(scene, no_noise(), 15);

  ASSERT_EQ(scan.size(), 500U);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_NEAR(point_of(scan, i).x, first_gap + step * 1.5, 1e-4);
  }
}

TEST(Distortion, IsNothingWhileTheVehicleStands) {
  // The vehicle does not move; the lorry is removed.
  const SceneKind kind{"house", "", [](std::uint64_t seed) {
                         Landscape landscape = lorry_before_a_house(seed);
                         landscape.moving = nullptr;
                         return landscape;
                       }};
  const Sensor sensor = sensor_ahead(10, 50);
  const Drive still(kind, sensor, {.height = 1.5}, 1);
  const Drive distorted(kind, sensor, {.height = 1.5}, 1, {.distortion = true});

  const SimulatedScan expected = still.scan(still.scene(), Noise{}, 2);
  const SimulatedScan scan = distorted.scan(distorted.scene(), Noise{}, 2);

  EXPECT_EQ(scan.xyzi, expected.xyzi);
  EXPECT_EQ(scan.classes, expected.classes);
  EXPECT_EQ(distorted.ground_of(scan, 2), still.ground_of(expected, 2));
}

TEST(Distortion, TimesIncreaseWithTheFiringsOverOnePeriod) {
  const Sensor& sensor = Sensor::named("vlp-16");
  const Drive drive(*find_scene_kind("highway"), sensor, {.height = sensor.height}, 1,
                    {.rate = 10, .distortion = true});

  const SimulatedScan scan = drive.scan(drive.scene(), no_noise(), 5);
  const std::vector<float> times = drive.times_of(scan);

  ASSERT_EQ(times.size(), scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Vector3 point = point_of(scan, i);
    double turn = std::atan2(point.y, point.x) / (2 * std::numbers::pi);
    if (turn < -1e-6) turn += 1;
    ASSERT_NEAR(times[i], 0.1 * turn, 1e-5) << "azimuth over the period, point " << i;
  }
}

TEST(Distortion, TruePosesUndoIt) {
  const Sensor& sensor = Sensor::named("vlp-16");
  for (const Extent& extent : {Extent{}, Extent{.stretches = 3}}) {
    constexpr int frame = 20;
    const Pace pace{.rate = 10, .speed = 20, .distortion = true};
    const Drive drive(*find_scene_kind("forest_track"), sensor, {.height = sensor.height}, 1, pace,
                      extent);
    const SimulatedScan scan = drive.scan(drive.scene(frame), no_noise(), frame);
    const std::vector<float> times = drive.times_of(scan);
    const std::vector<float> ground = drive.ground_of(scan, frame);
    double farthest = 0;
    double farthest_as_measured = 0;
    std::size_t points = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (!is_ground(class_of(scan, i))) continue;
      const auto above = [&](const Frame& pose) {
        const Vector3 world = pose.to_world(point_of(scan, i));
        return std::abs(world.z - drive.ground().height(world.x, world.y));
      };
      const double scans = frame + static_cast<double>(times[i]) * pace.rate;
      farthest = std::max(farthest, above(drive.pose_at(scans)));
      farthest_as_measured = std::max(farthest_as_measured, above(drive.poses()[frame]));
      ASSERT_NEAR(scan.xyzi[4 * i + 2], ground[i], 0.001F) << "true ground of a distorted point";
      ++points;
    }
    EXPECT_GT(points, 1'000U);
    EXPECT_LT(farthest, 0.001);
    EXPECT_GT(farthest_as_measured, 0.05) << "the sensor moves by 2 m in this scan";
  }
}

TEST(Distortion, MovingObjectsMoveDuringTheScan) {
  const SceneKind kind{"lorry", "", lorry_before_a_house};
  const Drive drive(kind, sensor_ahead(1, 64), {.height = 1.5}, 1, {.distortion = true});

  const SimulatedScan scan = drive.scan(drive.scene(), no_noise(), 1);
  const std::vector<float> times = drive.times_of(scan);

  ASSERT_EQ(scan.size(), 64U);
  constexpr double jump = step / 16;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double gap = first_gap + step * (1 + static_cast<double>(times[i]));
    EXPECT_NEAR(point_of(scan, i).x, gap, jump / 2 + 1e-4);
  }
}

TEST(Moving, ObjectsAreHiddenBehindStaticOnes) {
  const SimulatedScan scan = scan_at(8);

  ASSERT_EQ(scan.size(), 500U);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    ASSERT_EQ(class_of(scan, i), SemanticClass::building);
    ASSERT_NEAR(point_of(scan, i).x, 20, 1e-4);
  }
}

TEST(Moving, ObjectsAppearInReflections) {
  Mesh pane;
  add_wall(pane, 10, {.semantic = SemanticClass::building, .mirror = 1});
  const Scene scene = flat_scene(pane);
  Mesh behind;
  add_wall(behind, -4, lorry);
  const RayCaster moving(std::move(behind));
  Noise noise = no_noise();
  noise.mirroring = 1;

  const SimulatedScan scan =
      simulate(scene, sensor_ahead(20, 200), noise, above_origin(1.5), 1, {.moving = &moving});

  EXPECT_GT(count(scan, EchoKind::ghost), 200);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (scan.echoes[i] == EchoKind::ghost) {
      ASSERT_NEAR(point_of(scan, i).x, 10 + 14, 1e-4);
    }
  }
}

TEST(Moving, WithoutObjectsEqualsTheStaticScene) {
  const Scene scene = flat_scene();
  const RayCaster nothing{Mesh{}};
  const Sensor& sensor = Sensor::named("vlp-16");

  const SimulatedScan still = simulate(scene, sensor, Noise{}, above_origin(1), 1);
  const SimulatedScan empty =
      simulate(scene, sensor, Noise{}, above_origin(1), 1, {.moving = &nothing});

  EXPECT_EQ(still.xyzi, empty.xyzi);
}

}  // namespace
}  // namespace flagstone::sim
