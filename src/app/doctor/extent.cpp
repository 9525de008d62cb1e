// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/extent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

/// What a scan reaches, metres: 15 in a room, 150 on a motorway. The unit is the one that brings
/// the reach nearest to it.
constexpr double usual_reach = 50;

double metres_per_unit(double reach) {
  const std::array<double, 3> units{1, 0.01, 0.001};
  return *std::ranges::min_element(units, {}, [&](double unit) {
    return std::abs(std::log(std::max(reach, 1e-30) * unit / usual_reach));
  });
}

}  // namespace

bool Extent::is_far_away() const noexcept {
  const double away = std::max(std::abs(double{middle[0]}), std::abs(double{middle[1]}));
  return away > 3 * std::max(spread, 1e-30);
}

Extent extent_of(std::span<const Vector3f> places) {
  Extent extent;
  std::vector<float> values(places.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::ranges::transform(places, values.begin(), [&](const Vector3f& p) { return p[axis]; });
    extent.middle[axis] = percentile(values, 50);
    const double span = double{percentile(values, 95)} - double{percentile(values, 5)};
    extent.spread = std::max(extent.spread, span / 2);
  }
  std::ranges::transform(places, values.begin(), [](const Vector3f& p) {
    return static_cast<float>(std::hypot(double{p[0]}, double{p[1]}, double{p[2]}));
  });
  extent.reach = percentile(values, 99);
  extent.farthest = percentile(values, 100);
  extent.metres = metres_per_unit(extent.reach);
  return extent;
}

}  // namespace flagstone::doctor
