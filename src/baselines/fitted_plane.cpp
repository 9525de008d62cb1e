// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "baselines/fitted_plane.hpp"

#include <array>

#include "core/principal_axes.hpp"

namespace flagstone::baselines {
namespace {

std::array<float, 3> to_floats(const Vector3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

Plane FittedPlane::plane() const noexcept {
  return {static_cast<float>(normal[0]), static_cast<float>(normal[1]),
          static_cast<float>(normal[2]), static_cast<float>(d)};
}

FittedPlane fit_plane(const Moments& moments, const Vector3& origin) noexcept {
  if (moments.count < 3) return {};
  const PrincipalAxes axes = principal_axes(moments.covariance());
  Vector3 mean = moments.mean();
  double d = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    mean[k] += origin[k];
    d -= axes.normal[k] * mean[k];
  }
  return {moments.count, mean, axes.normal, d, axes.eigenvalues};
}

void set_ground_plane(const FittedPlane& fit, Patch& patch) noexcept {
  patch.verdict = Verdict::ground;
  patch.mean = to_floats(fit.mean);
  patch.normal = to_floats(fit.normal);
  patch.d = static_cast<float>(fit.d);
  patch.eigenvalues = to_floats(fit.eigenvalues);
  const double sum = fit.eigenvalues[0] + fit.eigenvalues[1] + fit.eigenvalues[2];
  patch.surface_variable = sum > 0 ? static_cast<float>(fit.eigenvalues[2] / sum) : 0.0f;
}

}  // namespace flagstone::baselines
