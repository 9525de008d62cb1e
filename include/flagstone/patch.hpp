// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace flagstone {

/// Why a patch was taken for ground, or was not.
enum class Verdict : std::uint16_t {
  ground,          ///< passed every term of the ground likelihood
  ground_flat,     ///< too high for the elevation term, brought back by its flatness
  too_few_points,  ///< not enough points in the bin to fit a plane
  no_plane,        ///< fewer than three points survived the fit
  not_upright,     ///< the normal leans too far: a wall, a hedge, a trunk
  too_high,        ///< lies above where ground can be at that range, and is not flat enough
  mixed,           ///< `surface`: as many points just above the plane as in it: a wall, a bush
  off_surface,     ///< `surface`: above or below what ground nearer to the sensor lets expect
};

/// Name of a verdict, e.g. "not_upright".
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

/// One bin S_n of the zone model that holds points, the plane fitted to it and what was made of it.
/// Paper: sections III-B to III-D. Where no plane was fitted, the plane's fields are zero.
///
/// The bins of `surface` are squares: zone 0 those of 4 m, zone 1 those of 8 m; ring is the row and
/// sector the column, counted from the smallest y and x. It fits planes to samples, so that
/// ground_count is an estimate, and judges points by their heights, whatever their patch is; the
/// terms of the likelihood are zero.
struct Patch {
  std::uint16_t zone = 0;    ///< m - 1: 0 is the zone nearest the sensor
  std::uint16_t ring = 0;    ///< i - 1: ring within the zone, 0 is the innermost
  std::uint16_t sector = 0;  ///< j - 1: counted counter-clockwise from -x, i.e. from theta = -pi
  Verdict verdict = Verdict::too_few_points;  ///< what became of it, and why

  std::uint32_t point_count = 0;  ///< points of the bin, |S_n|
  std::uint32_t ground_count =
      0;  ///< points of the bin labelled ground; 0 if the patch is rejected
  std::uint32_t lower_ground_count =
      0;  ///< of those, points below the plane in one of their own: a ditch's bottom

  std::array<float, 3> mean{};         ///< mean of the ground set, metres, sensor frame
  std::array<float, 3> normal{};       ///< n = v_3, unit length, pointing up (z >= 0), eq. (4)
  float d = 0;                         ///< plane: normal . p + d = 0, metres
  std::array<float, 3> eigenvalues{};  ///< of the covariance, lambda_1 >= lambda_2 >= lambda_3, m^2

  float uprightness = 0;  ///< phi, eq. (9): 1 upright enough, 0 not
  float elevation = 0;    ///< psi, eq. (10): 0..1, above 0.5 low enough to be ground
  float flatness = 0;     ///< varphi, eq. (11): 1, or the gain that may bring a high patch back
  float likelihood = 0;   ///< f, eq. (8): product of the three; ground if above 0.5, eq. (12)
  float surface_variable = 0;  ///< sigma = lambda_3 / (lambda_1 + lambda_2 + lambda_3), 0..1/3

  /// Does this patch count as ground?
  [[nodiscard]] constexpr bool is_ground() const noexcept {
    return verdict == Verdict::ground || verdict == Verdict::ground_flat;
  }
};

}  // namespace flagstone
