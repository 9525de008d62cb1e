// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/mounting.hpp"

#include <cmath>
#include <numbers>

namespace flagstone::sim {

Frame vehicle_pose(const Ground& ground, double x, double y, double yaw) {
  constexpr double wheelbase = 2.7;  // of KITTI's car, metres
  constexpr double track = 1.6;
  return frame_on_wheels(ground, x, y, yaw, wheelbase, track);
}

Frame sensor_pose(const Frame& vehicle, const Mounting& mounting) {
  constexpr double radians = std::numbers::pi / 180;
  Frame pose = raised(vehicle, mounting.height);
  const double pitch = mounting.pitch * radians;
  const Vector3 up = std::sin(pitch) * pose.forward + std::cos(pitch) * pose.up;
  pose.forward = std::cos(pitch) * pose.forward - std::sin(pitch) * pose.up;
  const double roll = mounting.roll * radians;
  pose.up = std::cos(roll) * up - std::sin(roll) * pose.left;
  pose.left = std::cos(roll) * pose.left + std::sin(roll) * up;
  return pose;
}

Frame sensor_pose(const Ground& ground, const Sensor& sensor, double x, double y, double yaw) {
  return sensor_pose(vehicle_pose(ground, x, y, yaw), {.height = sensor.height});
}

}  // namespace flagstone::sim
