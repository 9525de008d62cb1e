// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/cascaded_planes.hpp"

#include <cmath>
#include <numbers>

#include "lab/baselines/ransac_search.hpp"

namespace flagstone::baselines {
namespace {

RansacConfig search_of(const CascadedConfig& config) {
  RansacConfig search;
  search.distance_threshold = config.max_distance;
  search.max_trials = config.max_trials;
  search.min_consensus = 4;  // more than the three points of the sample
  return search;
}

/// `plane` must not be vertical.
double height_at(const Plane& plane, double x, double y) noexcept {
  return -(plane.normal[0] * x + plane.normal[1] * y + plane.d) / plane.normal[2];
}

}  // namespace

ContinuousPlanes::ContinuousPlanes(const CascadedConfig& config)
    : sensor_height_(config.sensor_height),
      min_cosine_(std::cos(static_cast<double>(config.max_angle_change) * std::numbers::pi / 180)),
      max_height_change_(config.max_height_change),
      search_(search_of(config)) {
  search_.seed = config.seed;
}

Plane ContinuousPlanes::below_sensor() const noexcept {
  Plane plane;
  plane.count = 3;
  plane.mean = {0, 0, -sensor_height_};
  plane.normal = {0, 0, 1};
  plane.d = sensor_height_;
  return plane;
}

bool ContinuousPlanes::is_ground(const SinglePrecisionPlane& plane, float x, float y,
                                 float z) const noexcept {
  return std::abs(plane.distance(x, y, z)) <= search_.distance_threshold;
}

bool ContinuousPlanes::is_continuous(const Plane& plane, const Plane& previous, double x,
                                     double y) const noexcept {
  const double cosine = plane.normal[0] * previous.normal[0] +
                        plane.normal[1] * previous.normal[1] + plane.normal[2] * previous.normal[2];
  const bool is_level_enough = cosine >= min_cosine_ && plane.normal[2] > 0;  // false for NaN
  if (!is_level_enough) return false;
  return std::abs(height_at(plane, x, y) - height_at(previous, x, y)) <= max_height_change_;
}

Plane ContinuousPlanes::fit(const Coordinates& points, const Plane& previous, double x, double y,
                            std::size_t region) const noexcept {
  RansacConfig search = search_;
  search.seed += static_cast<int>(region);
  const RansacSearch found = search_plane(points, search);
  if (found.consensus < static_cast<std::size_t>(search.min_consensus)) return previous;
  const Plane plane = fit_plane(
      points, [&](float px, float py, float pz) { return is_ground(found.plane, px, py, pz); });
  return plane.exists() && is_continuous(plane, previous, x, y) ? plane : previous;
}

}  // namespace flagstone::baselines
