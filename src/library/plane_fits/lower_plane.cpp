// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/lower_plane.hpp"

#include <cstddef>

namespace flagstone::plane_fits {
namespace {

/// Minimum fraction of the points below the patch that must be in the plane.
constexpr double least_share = 0.6;

/// Limits of the standard deviations along the axes of the plane and across it, metres. Ground is
/// seen by at least two beams, or by one beam over a long distance if edges occlude it from all
/// others.
constexpr double least_length = 0.3;
constexpr double least_width = 0.1;
constexpr double least_length_of_one_beam = 0.5;
constexpr double most_thickness = 0.05;

/// Minimum z of the normal: the sides of a ditch are steep, up to 50 degrees, and reflections of
/// walls are steeper.
constexpr double least_normal_z = 0.64;

}  // namespace

bool is_lower_ground(const Plane& plane, double deep) noexcept {
  const auto deviates = [&](std::size_t axis, double by) {
    return plane.eigenvalues[axis] >= by * by;
  };
  const bool of_two_beams = deviates(0, least_length) && deviates(1, least_width);
  const bool of_one_beam = deviates(0, least_length_of_one_beam);
  return plane.count >= fewest_sunken_points && plane.count >= least_share * deep &&
         plane.normal[2] >= least_normal_z && (of_two_beams || of_one_beam) &&
         !deviates(2, most_thickness);
}

}  // namespace flagstone::plane_fits
