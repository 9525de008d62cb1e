// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// Signs that points were removed or merged.
struct Downsampling {
  /// Exponent of the range in the number of points per direction, at equal elevation and up to 30
  /// m: about 0 in an original scan, towards 2 with one point per voxel.
  double growth = 0;
  /// This exponent over the whole cloud: at least 1 if points are as dense far out as nearby.
  double growth_of_all = 0;
  /// Ratio of point densities in the x-y plane, near the origin to far out: at least 10 in most
  /// scans, about 1 in a cloud that was not recorded from one position.
  double crowding = 0;

  [[nodiscard]] bool is_voxel_averaged() const noexcept { return growth > 0.45; }
  [[nodiscard]] bool is_from_many_places() const noexcept {
    return crowding < 2.5 && growth_of_all > 0.7;
  }
};

/// `places`: metres; the sensor is at the origin, z is its rotation axis.
Downsampling find_downsampling(std::span<const Vector3f> places);

}  // namespace flagstone::doctor
