// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/ground_rings.hpp"

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
  std::vector<double> elevations(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    elevations[i] = sensor.elevations.front() - height * static_cast<double>(i) / (count - 1);
  }
  return elevations;
}

/// Radius of the edge after beam `i`, metres.
double edge_after(const std::vector<double>& radii, std::size_t i) {
  if (i + 1 < radii.size()) return (radii[i] + radii[i + 1]) / 2;
  const double gap = i > 0 ? radii[i] - radii[i - 1] : radii[i];
  return radii[i] + std::max(gap / 2, radii[i] / 20);
}

bool is_long_enough(const GroundRing& ring, bool is_first, const RingLengths& lengths) {
  const double least = lengths.growth * ring.middle();
  if (ring.beams < 2 && ring.length() < std::max(lengths.one_beam, least)) return false;
  return ring.length() >= (is_first ? lengths.first : std::max(lengths.shortest, least));
}

/// Rings of those beams that meet flat ground.
std::vector<GroundRing> rings_of_beams(const GroundBeams& beams, double begin,
                                       const RingLengths& lengths) {
  const std::vector<double>& radii = beams.radii();
  std::vector<GroundRing> rings;
  GroundRing ring{.inner = begin};
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (radii[i] <= begin) continue;
    ring.outer = edge_after(radii, i);
    ++ring.beams;
    ring.points += beams.points_a_turn();
    if (!is_long_enough(ring, rings.empty(), lengths)) continue;
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

}  // namespace

GroundBeams::GroundBeams(const Sensor& sensor)
    : least_fall_(-std::tan(radians(std::min(sensor.elevations.front(), 89.0)))),
      height_(sensor.height),
      max_range_(sensor.max_range) {
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

double GroundBeams::reach(double slope) const noexcept {
  const double fall = least_fall_ - slope;  // towards ground that rises beams fall less
  return fall * max_range_ <= height_ ? max_range_ : height_ / fall;
}

std::vector<GroundRing> ground_rings(const GroundBeams& beams, double begin, double reach,
                                     const RingLengths& lengths) {
  std::vector<GroundRing> rings = rings_of_beams(beams, begin, lengths);
  if (rings.empty()) return rings;
  while (rings.back().outer * (1 + lengths.beyond) <= reach) {
    const double inner = rings.back().outer;
    rings.push_back(
        {.inner = inner, .outer = inner * (1 + lengths.beyond), .points = beams.points_a_turn()});
  }
  return rings;
}

}  // namespace flagstone
