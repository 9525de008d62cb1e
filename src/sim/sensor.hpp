// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace flagstone::sim {

/// A spinning LiDAR as data: every beam fires once at each azimuth step.
struct Sensor {
  std::string name;
  std::vector<double> elevations;  ///< degrees above the horizontal, one per beam, highest first
  int azimuth_count = 0;           ///< firings a turn, evenly spaced, the first straight ahead
  double min_range = 0;            ///< nearer echoes are not reported, metres
  double max_range = 0;            ///< metres
  double range_sigma = 0;          ///< standard deviation of a measured range, metres
  double mount_height = 0;         ///< above the ground the vehicle stands on, metres

  /// Azimuth of a firing, degrees, counter-clockwise from straight ahead, 0 <= azimuth < 360.
  [[nodiscard]] double azimuth(int firing) const noexcept { return 360.0 * firing / azimuth_count; }
};

/// Velodyne HDL-64E at 10 turns a second as KITTI drives it. Angles and accuracy: Velodyne,
/// "HDL-64E S2 and S2.1 User's Manual and Programming Guide", and that of the S3: two blocks of 32
/// lasers, 1/3 degree apart from +2 to -8.33 degrees and 1/2 degree apart from -8.83 to -24.33;
/// 0.1728 degrees between firings at 10 Hz; range accuracy below 2 cm (one sigma), echoes nearer
/// than 0.9 m discarded. 1.73 m and the 80 m that the recordings keep: A. Geiger et al., CVPR 2012.
Sensor hdl_64e();

}  // namespace flagstone::sim
