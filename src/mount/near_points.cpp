// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "mount/near_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flagstone::mount {
namespace {

/// Ground may rise by this much ahead, degrees.
constexpr double steepest_slope = 20;

/// Range at which a point weighs a quarter of what one at the vehicle does, metres.
constexpr float weight_range = 5;

/// Scans are read in so many interleaved passes, so that any number of them covers all of a scan,
/// and no further once this many points were looked at.
constexpr std::size_t passes = 8;
constexpr std::size_t enough = 49152;

}  // namespace

NearPoints::NearPoints(const MountLimits& limits, bool looks_for_tilt)
    : nearest_square_(limits.own_vehicle * limits.own_vehicle),
      farthest_square_(limits.reach * limits.reach),
      cubes_a_metre_(static_cast<float>(cubes) / (2 * limits.reach)),
      taken_(cubes * cubes * cubes / 64),
      points_(most) {
  const double highest = steepest_slope + (looks_for_tilt ? double{limits.most_tilt} : 0);
  steepest_ = static_cast<float>(std::sin(highest * std::numbers::pi / 180));
}

std::span<const NearPoint> NearPoints::find(CloudView cloud, const Mount& mount,
                                            const Turn& level) noexcept {
  std::ranges::fill(taken_, 0);
  std::size_t found = 0;
  std::size_t seen = 0;
  const auto cube_of = [&](float v) {
    const float place = v * cubes_a_metre_ + centre;
    return std::min(static_cast<std::size_t>(std::max(place, 0.0f)), cubes - 1);
  };
  for (std::size_t pass = 0; pass < passes && seen < enough; ++pass) {
    for (std::size_t i = pass; i < cloud.size(); i += passes) {
      ++seen;
      const Point p = cloud[i];
      const Vector3f from_sensor = {p.x * mount.scale - mount.origin[0],
                                    p.y * mount.scale - mount.origin[1],
                                    p.z * mount.scale - mount.origin[2]};
      const float square = dot(from_sensor, from_sensor);
      const bool is_near = square > nearest_square_ && square <= farthest_square_;  // not if NaN
      if (!is_near || (p.x == 0 && p.y == 0 && p.z == 0)) continue;
      const float z = dot(level.z, from_sensor);
      if (z > 0 && z * z > steepest_ * steepest_ * square) continue;
      const float x = dot(level.x, from_sensor);
      const float y = dot(level.y, from_sensor);
      const std::size_t cube = (cube_of(z) * cubes + cube_of(y)) * cubes + cube_of(x);
      std::uint64_t& word = taken_[cube / 64];
      const std::uint64_t bit = std::uint64_t{1} << (cube % 64);
      if ((word & bit) != 0) continue;
      word |= bit;
      const float relative = square / (weight_range * weight_range);
      points_[found] = {x, y, z, 1 / ((1 + relative) * (1 + relative))};
      if (++found == most) return points_;
    }
  }
  return {points_.data(), found};
}

}  // namespace flagstone::mount
