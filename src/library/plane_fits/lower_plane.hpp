// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "library/core/plane.hpp"

namespace flagstone::plane_fits {

/// Points below the plane of a patch are also ground if they form a separate plane, such as the
/// bottom of a ditch or the ground below a drop. Ghost points from reflections are few or do not
/// form a plane.
///
/// A plane is fitted three times: to all these points, then to the points within each of these
/// distances of the previous plane, metres.
inline constexpr std::array<double, 2> sunken_fit_margins = {0.3, 0.15};

/// Points within this distance of the last plane are ground, metres.
inline constexpr double sunken_margin = 0.15;

/// Minimum number of points of a lower ground plane.
inline constexpr double fewest_sunken_points = 12;

/// True if the last plane is ground. `deep` is the number of all points below the patch.
[[nodiscard]] bool is_lower_ground(const Plane& plane, double deep) noexcept;

/// Height of a point above a plane, metres.
[[nodiscard]] inline double height_above(const Plane& plane, const Vector3& point) noexcept {
  return plane.normal[0] * point[0] + plane.normal[1] * point[1] + plane.normal[2] * point[2] +
         plane.d;
}

}  // namespace flagstone::plane_fits
