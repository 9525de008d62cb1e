// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "core/ground_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone {
namespace {

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Elevations of as many beams as would draw the same number of points one angle apart both ways.
std::vector<double> beams_of_rosette(const Sensor& sensor) {
  const double height = sensor.elevations.front() - sensor.elevations.back();
  const double width = sensor.azimuth_end - sensor.azimuth_begin;
  const double count = std::clamp(std::round(std::sqrt(sensor.firings * height / width)), 2.0, 1e3);
  std::vector<double> elevations;
  for (double i = 0; i < count; ++i) {
    elevations.push_back(sensor.elevations.front() - height * i / (count - 1));
  }
  return elevations;
}

/// Radius of the edge after beam `i`, metres.
double edge_after(const std::vector<double>& radii, std::size_t i, double end) {
  if (i + 1 < radii.size()) return (radii[i] + radii[i + 1]) / 2;
  const double gap = i > 0 ? radii[i] - radii[i - 1] : radii[i];
  return std::min(end, radii[i] + std::max(gap / 2, radii[i] / 20));
}

}  // namespace

GroundBeams::GroundBeams(const Sensor& sensor) {
  const std::vector<double> elevations =
      sensor.draws_rosette() ? beams_of_rosette(sensor) : sensor.elevations;
  for (const double elevation : elevations) {
    const double fall = std::sin(radians(-elevation));
    if (fall <= 0 || sensor.height >= sensor.max_range * fall) continue;
    radii_.push_back(sensor.height / std::tan(radians(-elevation)));
  }
  std::ranges::sort(radii_);
  const double firings = sensor.draws_rosette()
                             ? sensor.firings / static_cast<double>(elevations.size())
                             : sensor.firings;
  points_a_turn_ = firings * 360 / (sensor.azimuth_end - sensor.azimuth_begin);
}

std::vector<GroundRing> ground_rings(const GroundBeams& beams, double begin, double end,
                                     const RingLengths& lengths) {
  const std::vector<double>& radii = beams.radii();
  std::vector<GroundRing> rings;
  GroundRing ring{.inner = begin};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] <= begin) continue;
    ring.outer = edge_after(radii, i, end);
    ++ring.beams;
    ring.points += beams.points_a_turn();
    const double least =
        rings.empty() ? lengths.first : std::max(lengths.shortest, lengths.growth * ring.middle());
    if (ring.length() < least) continue;
    rings.push_back(ring);
    ring = {.inner = ring.outer};
  }
  if (ring.beams == 0) return rings;
  // What is left is too short for a ring of its own.
  if (rings.empty()) return {ring};
  rings.back().outer = ring.outer;
  rings.back().beams += ring.beams;
  rings.back().points += ring.points;
  return rings;
}

}  // namespace flagstone
