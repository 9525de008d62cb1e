// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "transform.hpp"

namespace flagstone_ros {

/// Low-pass filter of the accelerations of an IMU. At rest an IMU measures the force that supports
/// it, so sensor_msgs/Imu::linear_acceleration points up, as REP 145 specifies. The unit does not
/// matter. Not thread-safe.
class GravityFilter {
 public:
  /// Seconds without a sample after which the filter starts again.
  static constexpr double max_gap = 1;

  /// Adds a sample. `stamp`: time of the measurement, seconds. `time_constant`: seconds in which an
  /// earlier sample decays to 1/e; 0 for no filter. Samples older than the previous one are
  /// ignored, unless the clock went back by more than max_gap; so are zero and values that are not
  /// finite. Returns whether the sample was used.
  bool add(const Vector& acceleration, double stamp, std::string_view frame, double time_constant);

  /// The up direction in frame(); its length has no meaning. Nothing before the first sample.
  [[nodiscard]] std::optional<Vector> up() const;

  /// The frame of the last sample that was used.
  [[nodiscard]] const std::string& frame() const noexcept { return frame_; }

 private:
  Vector mean_ = {0, 0, 0};
  double stamp_ = 0;
  std::string frame_;
  bool has_started_ = false;
};

}  // namespace flagstone_ros
