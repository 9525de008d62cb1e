// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/fitted_plane.hpp"

namespace flagstone::baselines {

SinglePrecisionPlane single_precision(const Plane& plane) noexcept {
  return {static_cast<float>(plane.normal[0]), static_cast<float>(plane.normal[1]),
          static_cast<float>(plane.normal[2]), static_cast<float>(plane.d)};
}

void set_ground_plane(const Plane& fit, Patch& patch) noexcept {
  patch.verdict = Verdict::ground;
  set_plane(fit, patch);
  const double sum = fit.eigenvalues[0] + fit.eigenvalues[1] + fit.eigenvalues[2];
  patch.surface_variable = sum > 0 ? static_cast<float>(fit.eigenvalues[2] / sum) : 0.0f;
}

}  // namespace flagstone::baselines
