// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patchwork/plane_fit.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/principal_axes.hpp"

namespace flagstone::patchwork {
namespace {

/// Sums over the points that `in_set(x, y, z)` picks; coordinates as seen from `origin`.
template <class InSet>
Moments moments_of(const PackedPoints& points, const Vector3& origin, const InSet& in_set) {
  Moments sums;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = points.x()[i] - origin[0];
    const double y = points.y()[i] - origin[1];
    const double z = points.z()[i] - origin[2];
    if (in_set(x, y, z)) sums.add(x, y, z);
  }
  return sums;
}

double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Eq. (3): the plane through the mean, across the direction of least variance.
Plane plane_of(const Moments& moments) {
  if (moments.count < 3) return {};
  const PrincipalAxes axes = principal_axes(moments.covariance());
  const Vector3 mean = moments.mean();
  return {.count = moments.count,
          .mean = mean,
          .normal = axes.normal,
          .d = -dot(axes.normal, mean),
          .eigenvalues = axes.eigenvalues};
}

/// The same plane seen from the sensor instead of from `origin`.
Plane from_sensor(Plane plane, const Vector3& origin) {
  for (std::size_t k = 0; k < 3; ++k) plane.mean[k] += origin[k];
  plane.d -= dot(plane.normal, origin);
  return plane;
}

}  // namespace

PlaneFit::PlaneFit(const PatchworkConfig& config) noexcept
    : seed_count_(config.seed_count),
      seed_height_(config.seed_height),
      distance_margin_(config.distance_margin),
      noise_margin_(config.noise_margin),
      iterations_(config.iterations),
      keep_below_margin_(config.keep_below_margin),
      judge_final_set_(config.judge_final_set) {}

PlaneFit::Result PlaneFit::fit(const PackedPoints& points, double seed_cut) noexcept {
  const double initial_height = mean_seed_height(points, seed_cut);
  const Vector3 origin = {points.x()[0], points.y()[0], points.z()[0]};

  // G^0, eq. (4), with the points below the margin kept out where the paper has it so.
  const double ceiling = initial_height + seed_height_ - origin[2];
  const double floor =
      keep_below_margin_ ? -std::numeric_limits<double>::infinity() : seed_cut - origin[2];
  Moments moments = moments_of(points, origin,
                               [&](double, double, double z) { return z < ceiling && z >= floor; });

  // G^(l+1), eqs. (5) and (6): the points less than M_d above the plane of G^l, and not so far
  // below it that they are noise. The moments of one iteration's set are taken while the set is
  // chosen.
  Plane plane;
  for (int l = 0; l < iterations_; ++l) {
    plane = plane_of(moments);
    if (!plane.exists()) return {};
    if (l + 1 == iterations_ && !judge_final_set_) break;
    const Vector3 n = plane.normal;
    const double top = distance_margin_ - plane.d;
    const double bottom = -noise_margin_ - plane.d;
    moments = moments_of(points, origin, [&](double x, double y, double z) {
      const double height = n[0] * x + n[1] * y + n[2] * z;
      return height < top && height >= bottom;
    });
  }

  const Plane judged = judge_final_set_ ? plane_of(moments) : plane;
  if (!judged.exists()) return {};
  return {from_sensor(plane, origin), from_sensor(judged, origin)};
}

/// z-bar_init, eq. (4): mean height of the N_seed lowest points that are not below the margin.
/// Where all are below it, 0, as in the public code.
double PlaneFit::mean_seed_height(const PackedPoints& points, double seed_cut) noexcept {
  float* heights = heights_.data();
  float* end = std::copy_if(points.z().begin(), points.z().end(), heights,
                            [&](float z) { return z >= seed_cut; });
  const std::ptrdiff_t seeds = std::min<std::ptrdiff_t>(seed_count_, end - heights);
  if (seeds == 0) return 0;
  std::nth_element(heights, heights + seeds - 1, end);
  std::sort(heights, heights + seeds);  // the sum must not depend on the order of the input
  double sum = 0;
  for (float* z = heights; z < heights + seeds; ++z) sum += *z;
  return sum / static_cast<double>(seeds);
}

}  // namespace flagstone::patchwork
