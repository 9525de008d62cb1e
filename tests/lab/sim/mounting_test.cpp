// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/mounting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lab/sim/drive.hpp"
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

TEST(Mounting, HeightsAreMeasuredAlongTheVehicleHoweverTheSensorLeans) {
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

}  // namespace
}  // namespace flagstone::sim
