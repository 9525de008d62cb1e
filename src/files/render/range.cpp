// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/range.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::render {
namespace {

constexpr double widest = 1000;

std::vector<double> distances(CloudView cloud, std::span<const Label> labels) {
  std::vector<double> all;
  all.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point point = cloud[i];
    const double distance = std::hypot(double{point.x}, double{point.y});
    if (labels[i] != Label::invalid && std::isfinite(distance)) all.push_back(distance);
  }
  return all;
}

}  // namespace

double suitable_range(CloudView cloud, std::span<const Label> labels,
                      const PatchworkConfig* zones) {
  const double bound = zones != nullptr ? double{zones->zones.back().ring_radii.back()} : widest;
  std::vector<double> all = distances(cloud, labels);
  if (all.empty()) return zones != nullptr ? bound : 50;
  return std::min(bound, std::max(10.0, 10 * std::ceil(percentile(all, 98) / 10)));
}

double ring_step(double range) noexcept {
  const double largest = range / 3;
  const double power = std::pow(10, std::floor(std::log10(largest)));
  if (5 * power <= largest) return 5 * power;
  if (2 * power <= largest) return 2 * power;
  return power;
}

std::vector<double> circle_radii(double range, const PatchworkConfig* zones) {
  std::vector<double> radii;
  if (zones != nullptr) {
    radii.push_back(zones->min_range);
    for (const Zone& zone : zones->zones) radii.push_back(zone.ring_radii.back());
    return radii;
  }
  const double step = ring_step(range);
  for (int ring = 1; ring * step < 2 * range; ++ring) radii.push_back(ring * step);
  return radii;
}

}  // namespace flagstone::render
