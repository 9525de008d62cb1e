// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sensor_poses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace flagstone_ros {

std::optional<std::string> SensorPoses::add_transform(std::string_view parent,
                                                      std::string_view child,
                                                      const Vector& translation,
                                                      const Quaternion& rotation) {
  const std::optional<Transform> to_parent = transform_of(translation, rotation);
  if (!to_parent) {
    return fmt::format(
        "/tf_static: {}: translation ({}), rotation ({}) is not a transform (expected finite "
        "numbers and a rotation other than zero)",
        child, fmt::join(translation, ", "), fmt::join(rotation, ", "));
  }
  const std::scoped_lock lock(mutex_);
  frames_.set(parent, child, *to_parent);
  return std::nullopt;
}

std::optional<std::string> SensorPoses::add_acceleration(const Vector& acceleration, double stamp,
                                                         std::string_view frame,
                                                         double time_constant) {
  const std::scoped_lock lock(mutex_);
  if (gravity_.add(acceleration, stamp, frame, time_constant)) return std::nullopt;
  return fmt::format(
      "imu: acceleration ({}) at {:.3f} s is not used (expected finite numbers, not all zero, in "
      "order of time)",
      fmt::join(acceleration, ", "), stamp);
}

void SensorPoses::forget_gravity() {
  const std::scoped_lock lock(mutex_);
  gravity_ = {};
}

SensorPose SensorPoses::find(std::string_view cloud_frame, std::string_view sensor_frame,
                             bool uses_imu) const {
  if (sensor_frame.empty()) sensor_frame = cloud_frame;
  const std::scoped_lock lock(mutex_);
  const auto to_sensor_from = [&](std::string_view frame, std::string_view whose,
                                  const char* problem) {
    const std::optional<Transform> found = frames_.find(frame, sensor_frame);
    if (found) return *found;
    const std::vector<std::string> known = frames_.names();
    throw CloudSkipped(
        problem,
        fmt::format("/tf_static: no transform from the frame '{}' of the {} to '{}' (expected a "
                    "chain of static transforms; known frames: {})",
                    frame, whose, sensor_frame,
                    known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
  };
  SensorPose pose{.to_sensor = to_sensor_from(cloud_frame, "cloud", "transform"), .up = {}};
  if (!uses_imu) return pose;
  const std::optional<Vector> up = gravity_.up();
  if (!up)
    throw CloudSkipped("gravity", "imu: no acceleration has arrived (expected for tilt imu)");
  pose.up = rotate(to_sensor_from(gravity_.frame(), "IMU", "imu transform"), *up);
  return pose;
}

}  // namespace flagstone_ros
