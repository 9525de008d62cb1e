// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/beams.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flagstone::sim {
namespace {

constexpr double radians = std::numbers::pi / 180;

}  // namespace

Beams::Beams(const Sensor& sensor, int number)
    : row_length_(static_cast<std::size_t>(sensor.firings)) {
  if (sensor.draws_rosette()) {
    add_rosette(sensor, number);
  } else {
    add_rows(sensor);
  }
}

void Beams::add_rows(const Sensor& sensor) {
  struct Heading {
    double x, y;
  };
  const double field_of_view = sensor.azimuth_end - sensor.azimuth_begin;
  const int steps = sensor.sees_all_around() ? sensor.firings : std::max(sensor.firings - 1, 1);
  std::vector<Heading> headings;
  headings.reserve(row_length_);
  for (int firing = 0; firing < sensor.firings; ++firing) {
    const double azimuth = (sensor.azimuth_begin + field_of_view * firing / steps) * radians;
    headings.push_back({.x = std::cos(azimuth), .y = std::sin(azimuth)});
  }
  directions_.reserve(sensor.elevations.size() * headings.size());
  for (const double elevation : sensor.elevations) {
    const double across = std::cos(elevation * radians);
    const double up = std::sin(elevation * radians);
    for (const Heading& heading : headings) {
      directions_.emplace_back(across * heading.x, across * heading.y, up);
    }
  }
}

void Beams::add_rosette(const Sensor& sensor, int number) {
  const double azimuth_middle = (sensor.azimuth_begin + sensor.azimuth_end) / 2;
  const double azimuth_bend = (sensor.azimuth_end - sensor.azimuth_begin) / 4;
  const double elevation_middle = (sensor.elevations.front() + sensor.elevations.back()) / 2;
  const double elevation_bend = (sensor.elevations.front() - sensor.elevations.back()) / 4;
  directions_.reserve(row_length_);
  for (int firing = 0; firing < sensor.firings; ++firing) {
    const double scans = number + static_cast<double>(firing) / sensor.firings;
    double azimuth = azimuth_middle;
    double elevation = elevation_middle;
    for (const double turns : sensor.rosette) {
      const double turned = 2 * std::numbers::pi * turns * scans;
      azimuth += azimuth_bend * std::cos(turned);
      elevation += elevation_bend * std::sin(turned);
    }
    const double across = std::cos(elevation * radians);
    directions_.emplace_back(across * std::cos(azimuth * radians),
                             across * std::sin(azimuth * radians), std::sin(elevation * radians));
  }
}

}  // namespace flagstone::sim
