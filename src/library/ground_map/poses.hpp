// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/ground_map.hpp"

namespace flagstone {

/// A position or direction with double precision, metres.
struct WorldVector {
  double x = 0, y = 0, z = 0;
};

/// Largest coordinate of a position, metres.
inline constexpr double max_world_position = 1e7;

/// True if the pose is finite, within max_world_position, and its rotation is a rotation.
bool is_valid(const Pose& pose) noexcept;

/// A direction of the sensor frame in the world frame.
inline WorldVector rotated(const Pose& pose, double x, double y, double z) noexcept {
  const auto& r = pose.rotation;
  return {.x = r[0] * x + r[1] * y + r[2] * z,
          .y = r[3] * x + r[4] * y + r[5] * z,
          .z = r[6] * x + r[7] * y + r[8] * z};
}

/// A direction of the world frame in the sensor frame.
inline WorldVector rotated_back(const Pose& pose, double x, double y, double z) noexcept {
  const auto& r = pose.rotation;
  return {.x = r[0] * x + r[3] * y + r[6] * z,
          .y = r[1] * x + r[4] * y + r[7] * z,
          .z = r[2] * x + r[5] * y + r[8] * z};
}

/// The error for a pose that is not valid.
Status invalid_pose();

/// An error if the result has no heights of this cloud or the pose is not valid. `user` begins the
/// message.
Status check_scan(const char* user, CloudView cloud, const Segmentation& result, const Pose& pose);

}  // namespace flagstone
