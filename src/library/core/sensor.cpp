// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/sensor.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>

#include "library/core/did_you_mean.hpp"
#include "library/core/known_sensors.hpp"
#include "library/core/setting.hpp"

namespace flagstone {
namespace {

constexpr double max_metres = 1000;

void check_elevations(const Sensor& sensor, const std::string& subject) {
  check_number(
      subject, "number of elevations", static_cast<double>(sensor.elevations.size()),
      {.low = sensor.draws_rosette() ? 2.0 : 1.0, .high = sensor.draws_rosette() ? 2.0 : 1024.0});
  for (std::size_t i = 0; i < sensor.elevations.size(); ++i) {
    check_number(subject, "elevations[" + std::to_string(i) + "]", sensor.elevations[i],
                 {.low = -90, .high = 90, .unit = "degrees"});
  }
  if (!std::ranges::is_sorted(sensor.elevations, std::greater_equal())) {
    throw std::invalid_argument(
        subject + ": elevations are not in descending order (list the highest first)");
  }
}

const std::vector<Sensor>& known_sensors() {
  static const std::vector<Sensor> sensors = make_known_sensors();
  return sensors;
}

}  // namespace

void Sensor::check() const {
  const std::string subject = "sensor " + (name.empty() ? "(unnamed)" : name);
  if (!rosette.empty()) {
    check_number(subject, "length of rosette", static_cast<double>(rosette.size()),
                 {.low = 2, .high = 2});
    for (const double turns : rosette) {
      check_number(subject, "rosette", turns, {.low = -1e6, .high = 1e6, .unit = "turns"});
    }
  }
  check_elevations(*this, subject);
  check_number(subject, "firings", firings, {.low = 1, .high = 1e6});
  check_number(subject, "azimuth_begin", azimuth_begin,
               {.low = -180, .high = 360, .unit = "degrees"});
  check_number(subject, "azimuth_end", azimuth_end,
               {.low = azimuth_begin,
                .high = std::min(azimuth_begin + 360, 360.0),
                .unit = "degrees",
                .exclusive_min = true});
  check_number(subject, "min_range", min_range, {.low = 0, .high = max_metres, .unit = "m"});
  check_number(subject, "max_range", max_range,
               {.low = min_range, .high = max_metres, .unit = "m", .exclusive_min = true});
  check_number(subject, "range_sigma", range_sigma, {.low = 0, .high = 10, .unit = "m"});
  check_number(subject, "height", height, {.low = 0, .high = 100, .unit = "m"});
}

const Sensor& Sensor::named(std::string_view name) {
  const auto sensors = known();
  const auto found = std::ranges::find_if(
      sensors, [&](const Sensor& sensor) { return equal_but_for_case(sensor.name, name); });
  if (found != sensors.end()) return *found;
  std::vector<std::string_view> names;
  for (const Sensor& sensor : sensors) names.push_back(sensor.name);
  throw std::invalid_argument(no_such("sensor", name, names));
}

std::span<const Sensor> Sensor::known() { return known_sensors(); }

}  // namespace flagstone
