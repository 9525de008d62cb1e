// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/polar_grid.hpp"

#include <limits>

namespace flagstone::baselines {
namespace {

PatchworkConfig one_zone(float min_range, float max_range, int rings, int sectors) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  PatchworkConfig config;
  config.min_range = min_range;
  config.zones = {{equal_rings(min_range, max_range, rings), sectors, -infinity}};
  config.noise_depth = infinity;  // disables the noise limit
  config.noise_slope = 0;
  return config;
}

}  // namespace

PolarGrid::PolarGrid(float min_range, float max_range, int rings, int sectors)
    : rings_(static_cast<std::uint32_t>(rings)),
      sectors_(static_cast<std::uint32_t>(sectors)),
      zones_(one_zone(min_range, max_range, rings, sectors)) {}

std::span<const std::uint32_t> PolarGrid::locate(const UsablePoints& points) noexcept {
  const std::size_t n = points.size();
  zones_.locate(points.x().data(), points.y().data(), points.z().data(), n, bins_.data());
  return {bins_.data(), n};
}

}  // namespace flagstone::baselines
