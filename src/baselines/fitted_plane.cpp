// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "baselines/fitted_plane.hpp"

#include <array>

namespace flagstone::baselines {
namespace {

std::array<float, 3> to_floats(const Vector3& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

SinglePrecisionPlane single_precision(const Plane& plane) noexcept {
  return {static_cast<float>(plane.normal[0]), static_cast<float>(plane.normal[1]),
          static_cast<float>(plane.normal[2]), static_cast<float>(plane.d)};
}

void set_ground_plane(const Plane& fit, Patch& patch) noexcept {
  patch.verdict = Verdict::ground;
  patch.mean = to_floats(fit.mean);
  patch.normal = to_floats(fit.normal);
  patch.d = static_cast<float>(fit.d);
  patch.eigenvalues = to_floats(fit.eigenvalues);
  const double sum = fit.eigenvalues[0] + fit.eigenvalues[1] + fit.eigenvalues[2];
  patch.surface_variable = sum > 0 ? static_cast<float>(fit.eigenvalues[2] / sum) : 0.0f;
}

}  // namespace flagstone::baselines
