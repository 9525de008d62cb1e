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

/// How far the points of a scan lie from the origin and from each other, in the file's units.
struct Extent {
  Vector3f middle{};    ///< the median of each coordinate
  double spread = 0;    ///< half of what nine in ten points span, along the axis where that is most
  double reach = 0;     ///< 99 in 100 points lie nearer to the origin
  double farthest = 0;  ///< the farthest point from it
  double metres = 1;    ///< metres a unit, as far as the reach tells: 1, 0.01 or 0.001

  /// Do the points lie far away from the origin, all on one side, as in coordinates of a map?
  [[nodiscard]] bool is_far_away() const noexcept;
};

/// What lies around the sensor, where the ego vehicle is.
struct EgoVehicle {
  double share = 0;  ///< of all points, those around the sensor that stand over the ground
  double roof = 0;   ///< height above the ground at which most of them lie, metres; 0: no roof seen
};

/// What one scan shows.
struct Examination {
  std::size_t points = 0;
  std::size_t zero = 0;
  std::size_t not_finite = 0;
  std::size_t repeated = 0;

  /// Points that have a place. The rest is not looked at where they are too few.
  [[nodiscard]] std::size_t usable() const noexcept { return points - zero - not_finite; }
  [[nodiscard]] bool has_enough_points() const noexcept { return usable() >= 1000; }

  Extent extent{};
  Downsampling downsampling{};
  FrameOrientation orientation{};  ///< not looked for where the points lie far away
  RingSource rings = RingSource::none;
  std::optional<BeamOrigin> origin{};  ///< turned so that the axis that is up is z
  FieldOfView view{};
  EgoVehicle vehicle{};
};

/// Looks at one scan. Any bit pattern is allowed in its coordinates.
Examination examine(const io::Cloud& cloud);

}  // namespace flagstone::doctor
