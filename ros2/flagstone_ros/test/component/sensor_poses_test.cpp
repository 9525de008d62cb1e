// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sensor_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace flagstone_ros {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;

constexpr Quaternion no_turn = {0, 0, 0, 1};
constexpr Quaternion turn_left = {0, 0, 1, 1};     // 90 degrees about z
constexpr Quaternion turn_about_x = {1, 0, 0, 1};  // 90 degrees

auto is_vector(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, 1e-12), DoubleNear(y, 1e-12), DoubleNear(z, 1e-12));
}

std::string problem_of(const SensorPoses& poses, const char* cloud, const char* sensor, bool imu) {
  try {
    static_cast<void>(poses.find(cloud, sensor, imu));
  } catch (const CloudSkipped& skipped) {
    return skipped.what();
  }
  return "none";
}

TEST(SensorPoses, NeedNoTransformForTheFrameOfTheSensor) {
  EXPECT_EQ(SensorPoses().find("lidar", "lidar", false).to_sensor, Transform());
  EXPECT_EQ(SensorPoses().find("lidar", "", false).to_sensor, Transform());
}

TEST(SensorPoses, ConnectFramesThroughTheirCommonAncestor) {
  SensorPoses poses;
  poses.add_transform("base", "lidar", {1, 0, 2}, no_turn);
  poses.add_transform("base", "mast", {0, 0, 1}, turn_left);
  poses.add_transform("mast", "camera", {5, 0, 0}, no_turn);

  const Transform to_lidar = poses.find("camera", "lidar", false).to_sensor;

  EXPECT_THAT(to_lidar.translation, is_vector(-1, 5, -1));
  EXPECT_THAT(rotate(to_lidar, {1, 0, 0}), is_vector(0, 1, 0));
}

TEST(SensorPoses, IgnoreALeadingSlashOfFrames) {
  SensorPoses poses;
  poses.add_transform("/base", "lidar", {1, 0, 2}, no_turn);

  EXPECT_THAT(poses.find("/lidar", "base", false).to_sensor.translation, is_vector(1, 0, 2));
}

TEST(SensorPoses, UseTheLastTransformOfAFrame) {
  SensorPoses poses;
  poses.add_transform("base", "lidar", {1, 0, 2}, no_turn);
  poses.add_transform("base", "lidar", {3, 0, 2}, no_turn);

  EXPECT_THAT(poses.find("lidar", "base", false).to_sensor.translation, is_vector(3, 0, 2));
}

TEST(SensorPoses, ReportAMissingTransformWithTheKnownFrames) {
  SensorPoses poses;
  poses.add_transform("map", "odom", {}, no_turn);

  EXPECT_THAT(problem_of(poses, "lidar", "base", false),
              HasSubstr("no transform from the frame 'lidar' of the cloud to 'base' (expected a "
                        "chain of static transforms; known frames: map, odom)"));
}

TEST(SensorPoses, EndAtACycleOfTransforms) {
  SensorPoses poses;
  poses.add_transform("a", "b", {}, no_turn);
  poses.add_transform("b", "a", {}, no_turn);

  EXPECT_THAT(problem_of(poses, "a", "lidar", false), HasSubstr("no transform"));
}

TEST(SensorPoses, RejectInvalidTransforms) {
  SensorPoses poses;

  EXPECT_THAT(poses.add_transform("base", "lidar", {}, {0, 0, 0, 0}),
              Optional(HasSubstr("/tf_static: lidar: translation (0, 0, 0), rotation (0, 0, 0, 0) "
                                 "is not a transform")));
  EXPECT_THAT(problem_of(poses, "lidar", "base", false), HasSubstr("known frames: none"));
}

TEST(SensorPoses, RotateGravityToTheFrameOfTheSensor) {
  SensorPoses poses;
  poses.add_transform("base", "imu", {0, 0, 1}, turn_about_x);
  poses.add_transform("base", "lidar", {0, 0, 2}, no_turn);
  poses.add_acceleration({0, 9.81, 0}, 10, "imu", 1);

  EXPECT_THAT(poses.find("lidar", "", true).up, Optional(is_vector(0, 0, 9.81)));
}

TEST(SensorPoses, WaitForTheFirstAcceleration) {
  EXPECT_THAT(problem_of(SensorPoses(), "lidar", "", true),
              HasSubstr("imu: no acceleration has arrived"));
}

TEST(SensorPoses, ReportAMissingTransformOfTheImu) {
  SensorPoses poses;
  poses.add_acceleration({0, 0, 9.81}, 10, "imu", 1);

  EXPECT_THAT(problem_of(poses, "lidar", "", true),
              HasSubstr("no transform from the frame 'imu' of the IMU to 'lidar'"));
}

TEST(SensorPoses, ReportAnAccelerationOfZero) {
  EXPECT_THAT(SensorPoses().add_acceleration({0, 0, 0}, 10, "imu", 1),
              Optional(HasSubstr("imu: acceleration (0, 0, 0) at 10.000 s is not used")));
}

}  // namespace
}  // namespace flagstone_ros
