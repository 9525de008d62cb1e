// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// How points were thinned out or added.
struct Downsampling {
  /// With which power of the range the points in a direction grow, between like elevations and up
  /// to 30 m: about 0 in a scan as the sensor made it, towards 2 where there is one point a voxel.
  double growth = 0;
  /// The same over the whole cloud: 1 and more where the points lie as densely far out as near by.
  double growth_of_all = 0;
  /// How many times as densely points lie near the origin as far out, seen from above: 10 and more
  /// in most scans, about 1 in a cloud that was not made from one place.
  double crowding = 0;

  [[nodiscard]] bool is_voxel_averaged() const noexcept { return growth > 0.45; }
  [[nodiscard]] bool is_from_many_places() const noexcept {
    return crowding < 2.5 && growth_of_all > 0.7;
  }
};

/// `places`: metres, the sensor in the origin, z is the axis it turns about.
Downsampling find_downsampling(std::span<const Vector3f> places);

}  // namespace flagstone::doctor
