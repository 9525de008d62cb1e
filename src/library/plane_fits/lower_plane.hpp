// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "library/core/plane.hpp"

namespace flagstone::plane_fits {

/// Points below the ground of a patch are ground themselves where they lie in a plane of their own:
/// the bottom of a ditch, the foot of a drop. Reflections are few or scattered.
///
/// They are fitted three times: all of them, then those within each of these distances of the plane
/// before, metres.
inline constexpr std::array<double, 2> sunken_fit_margins = {0.3, 0.15};

/// Those that in the end lie within this of the plane are ground, metres.
inline constexpr double sunken_margin = 0.15;

/// Fewer points are no ground.
inline constexpr double fewest_sunken_points = 12;

/// Is there ground in the last plane? `deep` is the number of all points below.
[[nodiscard]] bool is_lower_ground(const Plane& plane, double deep) noexcept;

/// How far a point lies above a plane, metres.
[[nodiscard]] inline double height_above(const Plane& plane, const Vector3& point) noexcept {
  return plane.normal[0] * point[0] + plane.normal[1] * point[1] + plane.normal[2] * point[2] +
         plane.d;
}

}  // namespace flagstone::plane_fits
