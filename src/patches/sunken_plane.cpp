// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patches/sunken_plane.hpp"

namespace flagstone::patches {
namespace {

/// Of all points below so many must lie in the plane.
constexpr double least_share = 0.6;

/// Standard deviations along the plane's axes and across it, metres: two beams at least have seen
/// ground, and it is flat.
constexpr double least_length = 0.3;
constexpr double least_width = 0.1;
constexpr double most_thickness = 0.05;

}  // namespace

bool is_sunken_ground(const Plane& plane, double deep, double least_normal_z) noexcept {
  const auto [length, width, thickness] = plane.eigenvalues;
  return plane.count >= fewest_sunken_points && plane.count >= least_share * deep &&
         plane.normal[2] >= least_normal_z && length >= least_length * least_length &&
         width >= least_width * least_width && thickness < most_thickness * most_thickness;
}

}  // namespace flagstone::patches
