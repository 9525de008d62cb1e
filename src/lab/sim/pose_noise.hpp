// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lab/sim/geometry.hpp"

namespace flagstone::sim {

/// Errors of the poses that an odometry measures.
struct PoseNoise {
  std::string_view name;
  std::string_view summary;  ///< one line for a list

  /// @name Independent errors of each pose, normally distributed
  /// @{
  double position_sigma = 0;  ///< of x, y and z, metres
  double angle_sigma = 0;     ///< of yaw, pitch and roll, degrees
  /// @}

  /// @name Errors that grow with the distance travelled, with random signs
  /// @{
  double scale_drift = 0;  ///< error of the distance, and of the height, in metres per metre
  double yaw_drift = 0;    ///< degrees per metre
  /// @}
};

/// All kinds, in the order of lists. The first one is "none".
std::span<const PoseNoise> pose_noises() noexcept;

/// The kind of this name; null if there is none.
const PoseNoise* find_pose_noise(std::string_view name) noexcept;

/// The poses of a run with errors. Drift begins at the first pose.
std::vector<Frame> measured_poses(std::span<const Frame> exact, const PoseNoise& noise,
                                  std::uint64_t seed);

}  // namespace flagstone::sim
