// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace flagstone {

/// Whether a patch is ground, and the test that decided it.
enum class Verdict : std::uint16_t {
  ground,          ///< ground: passed every test
  ground_flat,     ///< ground: too high for the elevation term, but flat enough to be accepted
  too_few_points,  ///< rejected: not enough points in the bin to fit a plane
  no_plane,        ///< rejected: fewer than three points remained for the fit
  not_upright,     ///< rejected: the normal is tilted too far, as on a wall, a hedge or a trunk
  too_high,        ///< rejected: higher than ground can be at that range, and not flat enough;
                   ///< or, by `surface`, seen from below
  mixed,           ///< rejected by `surface`: too many points just above the plane (wall, bush)
  off_surface,     ///< rejected by `surface`: too far from the height that other patches predict
};

/// Name of a `Verdict`, for example "not_upright".
constexpr const char* to_string(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::ground: return "ground";
    case Verdict::ground_flat: return "ground_flat";
    case Verdict::too_few_points: return "too_few_points";
    case Verdict::no_plane: return "no_plane";
    case Verdict::not_upright: return "not_upright";
    case Verdict::too_high: return "too_high";
    case Verdict::mixed: return "mixed";
    case Verdict::off_surface: return "off_surface";
  }
  return "unknown";
}

/// One bin S_n that contains points, with the plane fitted to it and its status.
/// Paper: sections III-B to III-D. If no plane was fitted, the fields of the plane are zero.
///
/// The bins of `surface` are squares, of 4 m in zone 0 and of 8 m in zone 1. `ring` is the row and
/// `sector` the column, counted from the smallest y and x. `surface` fits each plane to a sample of
/// the points, so ground_count is an estimate. For the fit, x and y are rounded to 1/128 m and z to
/// 1/256 m. `surface` labels points by their heights, independently of the status of their patch.
/// Its terms of the likelihood are zero.
struct Patch {
  std::uint16_t zone = 0;    ///< m - 1: zone, 0 is the nearest to the sensor
  std::uint16_t ring = 0;    ///< i - 1: ring within the zone, 0 is the innermost
  std::uint16_t sector = 0;  ///< j - 1: counted counter-clockwise from -x (theta = -pi)
  Verdict verdict = Verdict::too_few_points;  ///< status: ground, or the reason for rejection

  /// |S_n|: number of points in the bin. `surface` counts repeated points once if more than a third
  /// of the scan repeats other points.
  std::uint32_t point_count = 0;
  /// Number of points in the bin that are labelled ground; 0 if the patch is rejected.
  std::uint32_t ground_count = 0;
  /// Number of ground points that form a separate plane below, such as the bottom of a ditch.
  /// Included in ground_count.
  std::uint32_t lower_ground_count = 0;

  std::array<float, 3> mean{};         ///< mean of the ground set, metres, sensor frame
  std::array<float, 3> normal{};       ///< n = v_3, unit length, pointing up (z >= 0), eq. (4)
  float d = 0;                         ///< distance in normal . p + d = 0, metres
  std::array<float, 3> eigenvalues{};  ///< lambda_1 >= lambda_2 >= lambda_3 of the covariance, m^2

  float uprightness = 0;       ///< phi, eq. (9): 1 if the patch is upright enough, otherwise 0
  float elevation = 0;         ///< psi, eq. (10): 0 to 1; low enough to be ground if above 0.5
  float flatness = 0;          ///< varphi, eq. (11): 1, or the gain of a patch that is too high
  float likelihood = 0;        ///< f, eq. (8): product of the terms; ground if above 0.5, eq. (12)
  float surface_variable = 0;  ///< sigma = lambda_3 / (lambda_1 + lambda_2 + lambda_3), 0 to 1/3

  /// True if this patch is ground.
  [[nodiscard]] constexpr bool is_ground() const noexcept {
    return verdict == Verdict::ground || verdict == Verdict::ground_flat;
  }
};

}  // namespace flagstone
