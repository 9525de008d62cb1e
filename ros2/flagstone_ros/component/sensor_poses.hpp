// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "gravity_filter.hpp"
#include "static_frames.hpp"
#include "transform.hpp"

namespace flagstone_ros {

/// A cloud cannot be segmented now. what() is one line; problem() identifies it in the log.
class CloudSkipped : public std::runtime_error {
 public:
  CloudSkipped(std::string problem, const std::string& text)
      : std::runtime_error(text), problem_(std::move(problem)) {}

  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  std::string problem_;
};

/// From the frame of a cloud to the frame of the sensor.
struct SensorPose {
  Transform to_sensor;
  std::optional<Vector> up;  ///< in the frame of the sensor, if it comes from an IMU
};

/// The pose of the sensor from the messages on /tf_static and imu. Thread-safe.
class SensorPoses {
 public:
  /// Adds a transform of /tf_static. Returns the problem in one line if it is invalid.
  std::optional<std::string> add_transform(std::string_view parent, std::string_view child,
                                           const Vector& translation, const Quaternion& rotation);

  /// Adds a measurement of the IMU; see GravityFilter::add. Returns the problem in one line if it
  /// is not used.
  std::optional<std::string> add_acceleration(const Vector& acceleration, double stamp,
                                              std::string_view frame, double time_constant);

  /// Forgets the measurements of the IMU.
  void forget_gravity();

  /// The pose for clouds in the frame `cloud_frame`. An empty `sensor_frame` is the frame of the
  /// cloud. Throws CloudSkipped if a transform is missing or, with `uses_imu`, no acceleration has
  /// arrived.
  [[nodiscard]] SensorPose find(std::string_view cloud_frame, std::string_view sensor_frame,
                                bool uses_imu) const;

 private:
  mutable std::mutex mutex_;
  StaticFrames frames_;
  GravityFilter gravity_;
};

}  // namespace flagstone_ros
