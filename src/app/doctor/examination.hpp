// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "app/doctor/beams.hpp"
#include "app/doctor/downsampling.hpp"
#include "app/doctor/frame_orientation.hpp"
#include "files/io/cloud.hpp"

namespace flagstone::doctor {

/// Extent of the points of a scan, in the units of the file.
struct Extent {
  Vector3f middle{};    ///< the median of each coordinate
  double spread = 0;    ///< half of the range of the central 90 % of points, along the longest axis
  double reach = 0;     ///< 99 % of the points are closer to the origin
  double farthest = 0;  ///< distance of the farthest point from the origin
  double metres = 1;    ///< metres per unit, estimated from the reach: 1, 0.01 or 0.001

  /// True if all points are far from the origin on one side, as in map coordinates.
  [[nodiscard]] bool is_far_away() const noexcept;
};

/// Points on the ego vehicle.
struct EgoVehicle {
  double share = 0;  ///< fraction of points that are near the sensor and above the ground
  double roof = 0;   ///< height of most of these points above the ground, metres; 0: no roof
};

/// Results of one scan.
struct Examination {
  std::size_t points = 0;
  std::size_t zero = 0;
  std::size_t not_finite = 0;
  std::size_t repeated = 0;

  /// Number of valid points. If there are too few, the members below are not set.
  [[nodiscard]] std::size_t usable() const noexcept { return points - zero - not_finite; }
  [[nodiscard]] bool has_enough_points() const noexcept { return usable() >= 1000; }

  Extent extent{};
  Downsampling downsampling{};
  FrameOrientation orientation{};  ///< not estimated if the points are far away
  RingSource rings = RingSource::none;
  std::optional<BeamOrigin> origin{};  ///< in the frame rotated so that the up axis is z
  FieldOfView view{};
  EgoVehicle vehicle{};
};

/// Examines one scan. Its coordinates may have any value, including NaN, infinity and denormals.
Examination examine(const io::Cloud& cloud);

}  // namespace flagstone::doctor
