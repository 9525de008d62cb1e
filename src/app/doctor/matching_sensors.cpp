// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/matching_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flagstone::doctor {
namespace {

/// Beams of the last one or two percent may bring nothing back.
bool beams_match(const Summary& summary, const Sensor& sensor) {
  const int beams = summary.view.beams;
  if (beams == 0 || summary.is_voxel_averaged) return true;
  const auto most = static_cast<int>(sensor.elevations.size());
  return !sensor.draws_rosette() && beams <= most && 100 * beams >= 95 * most;
}

bool azimuths_match(const FieldOfView& view, const Sensor& sensor) {
  constexpr double near = 15;  // degrees; edges are ragged
  return std::abs(view.azimuth_width - (sensor.azimuth_end - sensor.azimuth_begin)) < near;
}

/// How far the elevations are from the sensor's, degrees; nothing where they do not fit. The sky
/// brings nothing back, so that the highest beams may be missing; the ground does.
std::optional<double> elevation_difference(const FieldOfView& view, const Sensor& sensor) {
  const double slack = sensor.draws_rosette() ? 8 : 2;  // a rosette is thin at its rim
  const double open_sky = sensor.draws_rosette() ? 25 : 15;
  const double bottom = std::abs(view.bottom - sensor.elevations.back());
  const double above_top = view.top - sensor.elevations.front();
  if (bottom > slack || above_top > slack || above_top < -open_sky) return {};
  return bottom + std::abs(above_top) / 4;
}

}  // namespace

std::vector<const Sensor*> matching_sensors(const Summary& summary) {
  std::vector<std::pair<double, const Sensor*>> matches;
  for (const Sensor& sensor : Sensor::known()) {
    constexpr double further_than_told = 1.3;
    const auto difference = elevation_difference(summary.view, sensor);
    if (difference && beams_match(summary, sensor) && azimuths_match(summary.view, sensor) &&
        summary.reach < further_than_told * sensor.max_range) {
      matches.emplace_back(*difference, &sensor);
    }
  }
  std::ranges::sort(matches, {}, &decltype(matches)::value_type::first);
  std::vector<const Sensor*> sensors;
  sensors.reserve(matches.size());
  for (const auto& [difference, sensor] : matches) sensors.push_back(sensor);
  return sensors;
}

}  // namespace flagstone::doctor
