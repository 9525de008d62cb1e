// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/lower_plane.hpp"

#include <cstddef>

namespace flagstone::plane_fits {
namespace {

/// Of all points below so many must lie in the plane.
constexpr double least_share = 0.6;

/// Standard deviations along the plane's axes and across it, metres. Two beams at least have seen
/// ground, or one has over a long way: between edges that hide the rest no other may meet it.
constexpr double least_length = 0.3;
constexpr double least_width = 0.1;
constexpr double least_length_of_one_beam = 0.5;
constexpr double most_thickness = 0.05;

/// Least z of the normal: the sides of a ditch are steep, up to 50 degrees, mirrored walls steeper.
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
