// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

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

/// The extent of at least one point.
Extent extent_of(std::span<const Vector3f> places);

}  // namespace flagstone::doctor
