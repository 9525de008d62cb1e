// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/beam_origin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

struct RingPoint {
  double range;  // horizontal, metres
  double z;
};

/// Some of the points that tell: near ones turn much when the origin moves, those on the vehicle
/// itself are not to be trusted.
std::vector<std::vector<RingPoint>> telling_points(std::span<const Vector3f> places,
                                                   const BeamRings& rings) {
  constexpr double nearest = 2.7;
  constexpr double farthest = 40;
  constexpr std::size_t enough = 40000;
  std::vector<std::vector<RingPoint>> points(static_cast<std::size_t>(rings.count));
  const std::size_t stride = places.size() / enough + 1;
  for (std::size_t i = 0; i < places.size(); i += stride) {
    const double range = std::hypot(double{places[i][0]}, double{places[i][1]});
    if (range < nearest || range > farthest) continue;
    points[static_cast<std::size_t>(rings.of_points[i])].push_back({range, double{places[i][2]}});
  }
  return points;
}

double median_deviation(std::vector<double>& values) {
  const double middle = percentile(values, 50);
  for (double& value : values) value = std::abs(value - middle);
  return percentile(values, 50);
}

/// Mean over points of their beam's median deviation, degrees.
double spread_from(const std::vector<std::vector<RingPoint>>& rings, double height) {
  constexpr std::size_t fewest = 20;
  double sum = 0;
  double count = 0;
  std::vector<double> elevations;
  for (const std::vector<RingPoint>& ring : rings) {
    if (ring.size() < fewest) continue;
    elevations.clear();
    for (const RingPoint& point : ring) {
      elevations.push_back(std::atan2(point.z - height, point.range) * 180 / std::numbers::pi);
    }
    const auto size = static_cast<double>(ring.size());
    sum += size * median_deviation(elevations);
    count += size;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace

bool BeamOrigin::is_elsewhere() const noexcept {
  return std::abs(height) > 0.5 && spread < 0.5 * spread_at_origin;
}

BeamOrigin find_beam_origin(std::span<const Vector3f> places, const BeamRings& rings,
                            double ground) {
  constexpr double lowest = 0.1;  // above the ground, metres
  constexpr double highest = 6;
  const auto points = telling_points(places, rings);
  BeamOrigin found{.spread = 1e30, .spread_at_origin = spread_from(points, 0)};
  const auto look = [&](double from, double to, double step) {
    const long steps = std::lround((to - from) / step);
    for (long i = 0; i <= steps; ++i) {
      const double height = from + static_cast<double>(i) * step;
      const double spread = spread_from(points, height);
      if (spread < found.spread) {
        found.height = height;
        found.spread = spread;
      }
    }
  };
  look(ground + lowest, ground + highest, 0.1);
  look(found.height - 0.08, found.height + 0.08, 0.02);
  return found;
}

}  // namespace flagstone::doctor
