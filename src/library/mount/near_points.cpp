// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/near_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "library/core/point_validity.hpp"

namespace flagstone::mount {
namespace {

/// Maximum upward slope of the ground, degrees.
constexpr double steepest_slope = 20;

/// Range at which the weight is a quarter of the weight at the vehicle, as a fraction of the reach.
constexpr float weight_range = 5.0f / 16;

/// A surface fills its cubes; ghost points and dust leave only a few points per cube. If the count
/// of a cube is below this fraction of the mean count at its range, its weight is reduced in
/// proportion.
constexpr float dense_share = 0.5f;

/// Scans are read in this number of interleaved passes, so that after any pass the points read
/// cover the whole scan. Reading stops after the pass that reaches this number of points.
constexpr std::size_t passes = 8;
constexpr std::size_t enough = 49152;

/// Number of range intervals within which counts are compared.
constexpr std::size_t shells = 16;

}  // namespace

NearPoints::NearPoints(const MountLimits& limits, bool looks_for_tilt)
    : nearest_square_(limits.ego_radius * limits.ego_radius),
      slots_(cubes * cubes * cubes),
      points_(most),
      counts_(most) {
  const double highest = steepest_slope + (looks_for_tilt ? double{limits.max_tilt} : 0);
  steepest_ = static_cast<float>(std::sin(highest * std::numbers::pi / 180));
}

std::span<const NearPoint> NearPoints::find(CloudView cloud, const Mount& mount, const Turn& level,
                                            float reach) noexcept {
  std::ranges::fill(slots_, none);
  const float farthest_square = reach * reach;
  const float cubes_a_metre = static_cast<float>(cubes) / (2 * reach);
  std::size_t found = 0;
  std::size_t seen = 0;
  const auto cube_of = [&](float v) {
    const float place = v * cubes_a_metre + centre;
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
      const bool is_near = square > nearest_square_ && square <= farthest_square;  // false for NaN
      if (!is_near || is_missing_return(p)) continue;
      const float z = dot(level.z, from_sensor);
      if (z > 0 && z * z > steepest_ * steepest_ * square) continue;
      const float x = dot(level.x, from_sensor);
      const float y = dot(level.y, from_sensor);
      const std::size_t cube = (cube_of(z) * cubes + cube_of(y)) * cubes + cube_of(x);
      std::uint16_t& slot = slots_[cube];
      if (slot != none) {
        ++counts_[slot];
        continue;
      }
      if (found == most) continue;
      slot = static_cast<std::uint16_t>(found);
      counts_[found] = 1;
      points_[found++] = {x, y, z, 0};
    }
  }
  weigh(found, reach);
  return {points_.data(), found};
}

void NearPoints::weigh(std::size_t found, float reach) noexcept {
  struct Shell {
    float count = 0;
    float cubes = 0;
  };
  std::array<Shell, shells> all{};
  const auto square_of = [&](std::size_t i) {
    const NearPoint& p = points_[i];
    return p.x * p.x + p.y * p.y + p.z * p.z;
  };
  const auto shell_of = [&](float square) -> Shell& {
    const auto index = static_cast<std::size_t>(std::sqrt(square) / reach * shells);
    return all[std::min(index, shells - 1)];
  };
  for (std::size_t i = 0; i < found; ++i) {
    Shell& shell = shell_of(square_of(i));
    shell.count += static_cast<float>(counts_[i]);
    shell.cubes += 1;
  }
  for (std::size_t i = 0; i < found; ++i) {
    const float square = square_of(i);
    const Shell& shell = shell_of(square);
    const float dense = dense_share * shell.count / shell.cubes;
    const float relative = square / (weight_range * weight_range * reach * reach);
    points_[i].weight =
        std::min(static_cast<float>(counts_[i]) / dense, 1.0f) / ((1 + relative) * (1 + relative));
  }
}

}  // namespace flagstone::mount
