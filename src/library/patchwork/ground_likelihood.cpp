// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/ground_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "library/core/exponential.hpp"

namespace flagstone::patchwork {
namespace {

/// exp(x) with x clamped to -300 to 300. A very small scale then gives a step, and the product of
/// two such steps is never 0 * infinity.
double bounded_exp(double x) { return exponential(std::clamp(x, -300.0, 300.0)); }

/// `value` in single precision, or 0 if it is denormal. WebAssembly has no mode that does this; see
/// ScopedFloatingPointMode.
float without_denormals(double value) {
  const auto number = static_cast<float>(value);
  return number < std::numeric_limits<float>::min() ? 0.0f : number;
}

}  // namespace

GroundLikelihood::GroundLikelihood(const PatchworkConfig& config, const std::vector<Ring>& rings)
    : uprightness_(config.uprightness),
      // Single precision rounds away the differences between mathematical libraries.
      smallest_normal_z_(static_cast<float>(
          std::cos(std::numbers::pi / 2 - config.uprightness.angle * std::numbers::pi / 180))),
      elevation_scale_(config.elevation.scale),
      flatness_(config.flatness) {
  const std::vector<float>& thresholds = config.flatness.thresholds;
  for (const Ring& ring : rings) {
    const std::size_t threshold = std::min(rings_.size(), thresholds.size() - 1);
    const double r = ring.center_radius;
    rings_.push_back({.near = config.elevation.enabled && r < config.elevation.range,
                      .midpoint = -static_cast<double>(config.sensor_height) +
                                  config.elevation.base * exponential(config.elevation.growth * r),
                      .flat = thresholds[threshold]});
  }
}

/// phi, eq. (9). The normal has unit length and points up.
double GroundLikelihood::uprightness(const Plane& plane) const noexcept {
  return !uprightness_.enabled || plane.normal[2] > smallest_normal_z_ ? 1 : 0;
}

/// psi, eq. (10), with the scale of the logistic function made explicit.
double GroundLikelihood::elevation(const Plane& plane, std::size_t ring) const noexcept {
  if (!rings_[ring].near) return 1;
  return 1 / (1 + bounded_exp((plane.mean[2] - rings_[ring].midpoint) / elevation_scale_));
}

/// varphi, eq. (11), with the scale of the exponential function made explicit.
double GroundLikelihood::flatness(double elevation, double sigma, std::size_t ring) const noexcept {
  if (!flatness_.enabled || !(elevation < 0.5)) return 1;
  const double excess = (sigma - rings_[ring].flat) / flatness_.scale;
  return static_cast<double>(flatness_.gain) * bounded_exp(-excess);
}

void GroundLikelihood::judge(const Plane& plane, std::size_t ring, Patch& patch) const noexcept {
  const Vector3& lambda = plane.eigenvalues;
  const double spread = lambda[0] + lambda[1] + lambda[2];
  const double sigma = spread > 0 ? lambda[2] / spread : 0;

  const double phi = uprightness(plane);
  const double psi = elevation(plane, ring);
  const double varphi = flatness(psi, sigma, ring);
  const double f = phi * psi * varphi;  // eq. (8): a factor of the product of eq. (7)

  patch.uprightness = static_cast<float>(phi);
  patch.elevation = without_denormals(psi);
  patch.flatness = without_denormals(std::min(varphi, 1e30));
  patch.likelihood = without_denormals(std::min(f, 1e30));
  patch.surface_variable = static_cast<float>(sigma);
  if (f > 0.5) {  // eq. (12): the ground set of the patch is part of the ground
    patch.verdict = psi < 0.5 ? Verdict::ground_flat : Verdict::ground;
  } else {
    patch.verdict = phi == 0 ? Verdict::not_upright : Verdict::too_high;
  }
}

}  // namespace flagstone::patchwork
