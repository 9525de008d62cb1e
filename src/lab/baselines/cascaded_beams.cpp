// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/cascaded_beams.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flagstone::baselines {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Results are rounded to single precision, which almost always hides differences between
/// mathematical libraries in the last bit.
double tangent(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

/// Distance at which a beam hits ground that is `height` below the sensor and rises outward with
/// slope `rise`, m/m.
float ring_radius(double elevation, double rise, double height) {
  const double closing = rise - tangent(elevation);
  return closing > 0 ? static_cast<float>(height / closing) : infinity;
}

}  // namespace

Beams::Beams(const CascadedConfig& config) {
  const double height = config.sensor_height;
  const double steepest = tangent(config.max_slope);
  const std::vector<float>& elevations = config.beam_elevations;
  for (const float elevation : elevations) {
    slope_radii_.push_back(ring_radius(elevation, steepest, height));
    flat_radii_.push_back(ring_radius(elevation, 0, height));
  }
  for (std::size_t i = 0; i + 1 < elevations.size(); ++i) {
    const double halfway =
        (static_cast<double>(elevations[i]) + static_cast<double>(elevations[i + 1])) / 2;
    between_.push_back(static_cast<float>(tangent(halfway)));
  }
}

std::uint16_t Beams::nearest(float range, float height) const noexcept {
  const auto above =
      std::ranges::partition_point(between_, [=](float t) { return t * range <= height; });
  return static_cast<std::uint16_t>(above - between_.begin());
}

float Beams::least_distance(std::size_t lower, std::size_t upper) const noexcept {
  if (slope_radii_[upper] == infinity) return infinity;
  return slope_radii_[upper] - slope_radii_[lower];
}

}  // namespace flagstone::baselines
