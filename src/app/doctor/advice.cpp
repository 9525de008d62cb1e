// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace flagstone::doctor {
namespace {

/// Up to 5 % of the beams may have no returns.
bool beams_match(const Summary& summary, const Sensor& sensor) {
  const int beams = summary.view.beams;
  if (beams == 0 || summary.is_voxel_averaged) return true;
  const auto most = static_cast<int>(sensor.elevations.size());
  return !sensor.draws_rosette() && beams <= most && 100 * beams >= 95 * most;
}

bool azimuths_match(const FieldOfView& view, const Sensor& sensor) {
  constexpr double near = 15;  // degrees; the edges of the view are ragged
  return std::abs(view.azimuth_width - (sensor.azimuth_end - sensor.azimuth_begin)) < near;
}

/// Difference between the elevations in the scan and those of the sensor, degrees; empty if they do
/// not match. The highest beams may be missing, because the sky gives no returns; the ground does.
std::optional<double> elevation_difference(const FieldOfView& view, const Sensor& sensor) {
  const double slack = sensor.draws_rosette() ? 8 : 2;  // a rosette has few points at its rim
  const double open_sky = sensor.draws_rosette() ? 25 : 15;
  double bottom = std::abs(view.bottom - sensor.elevations.back());
  if (sensor.name == "hdl-64e") {
    // Its lower beams leave its head lower, and appear steeper from where the upper beams meet.
    bottom = std::min(bottom, std::abs(view.bottom - (sensor.elevations.back() - 2)));
  }
  const double above_top = view.top - sensor.elevations.front();
  if (bottom > slack || above_top > slack || above_top < -open_sky) return {};
  return bottom + std::abs(above_top) / 4;
}

float rounded(double value, double step) {
  const double result = std::round(value / step) * step;
  return static_cast<float>(result == 0 ? 0 : result);  // no -0
}

/// A TOML float with at most `digits` digits after the point.
std::string number(float value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  while (text.ends_with('0') && !text.ends_with(".0")) text.pop_back();
  return text;
}

std::string numbers(const Vector3f& values, int digits) {
  return fmt::format("[{}, {}, {}]", number(values[0], digits), number(values[1], digits),
                     number(values[2], digits));
}

/// Position of the sensor: metres, in the frame of the cloud rotated so that the axis is z.
Vector3f origin_of(const Summary& summary, const CommonOrientation& orientation,
                   const Expected& expected, std::string_view sensor, double upright) {
  const double expected_origin = orientation.ground + double{expected.sensor_height} / upright;
  if (!summary.beam_origin) {
    return {0, 0, orientation.ground > highest_ground ? static_cast<float>(expected_origin) : 0};
  }
  auto [x, y, z] = *summary.beam_origin;
  constexpr double least_offset =
      0.3;  // metres; smaller offsets may be due to the motion of the vehicle
  if (std::hypot(x, y) < least_offset) x = y = 0;
  const double lift = double{z} - expected_origin;
  const bool is_lifted = sensor == "hdl-64e" && lift > 0 && lift < hdl_64e_lift;
  return {x, y, is_lifted ? static_cast<float>(expected_origin) : z};
}

bool differs(const Vector3f& a, const Vector3f& b) { return a != b; }

}  // namespace

std::vector<const Sensor*> matching_sensors(const Summary& summary) {
  std::vector<std::pair<double, const Sensor*>> matches;
  for (const Sensor& sensor : Sensor::known()) {
    constexpr double range_slack = 1.3;
    const auto difference = elevation_difference(summary.view, sensor);
    if (difference && beams_match(summary, sensor) && azimuths_match(summary.view, sensor) &&
        summary.reach < range_slack * sensor.max_range) {
      matches.emplace_back(*difference, &sensor);
    }
  }
  std::ranges::sort(matches, {}, &decltype(matches)::value_type::first);
  std::vector<const Sensor*> sensors;
  sensors.reserve(matches.size());
  for (const auto& [difference, sensor] : matches) sensors.push_back(sensor);
  return sensors;
}

double height_doubt(const CommonOrientation& orientation) {
  return least_height_difference + (orientation.highest_ground - orientation.lowest_ground) / 4;
}

Advice advise(const Summary& summary, const CommonOrientation& orientation,
              const Expected& expected, const std::vector<const Sensor*>& sensors) {
  Advice advice;
  if (!sensors.empty()) advice.sensor = sensors.front()->name;
  Mount& mount = advice.mount;
  mount.scale = static_cast<float>(summary.metres);

  for (std::size_t i = 0; i < 3; ++i) {
    mount.up[i] = orientation.is_tilted() ? rounded(orientation.up[i], 1e-4) : orientation.axis[i];
  }

  const double upright =
      orientation.is_tilted() ? double{mount::dot(orientation.up, orientation.axis)} : 1;
  const Vector3f origin = origin_of(summary, orientation, expected, advice.sensor, upright);
  const Vector3f in_cloud = mount::turn_to_z(orientation.axis).undo(origin);
  for (std::size_t i = 0; i < 3; ++i) mount.origin[i] = rounded(in_cloud[i], 0.01);

  const double height = (double{rounded(origin[2], 0.01)} - orientation.ground) * upright;
  const bool as_expected =
      std::abs(height - double{expected.sensor_height}) < height_doubt(orientation);
  mount.sensor_height = as_expected ? expected.sensor_height : rounded(height, 0.01);

  const Mount usual;
  advice.has_mount =
      differs(mount.up, usual.up) || differs(mount.origin, usual.origin) || summary.metres != 1;
  return advice;
}

std::string to_toml(const Advice& advice) {
  const Mount usual;
  const Mount& mount = advice.mount;
  std::string text = "# Settings from 'flagstone doctor'\n";
  if (!advice.sensor.empty()) text += fmt::format("sensor = \"{}\"\n", advice.sensor);
  text += fmt::format("sensor_height = {}  # metres above the ground\n",
                      number(mount.sensor_height, 3));
  if (!advice.has_mount) return text;
  text += "\n[mount]\n";
  if (differs(mount.up, usual.up)) {
    text += fmt::format("tilt = \"fixed\"\nup = {}  # up direction in the cloud's frame\n",
                        numbers(mount.up, 4));
  }
  if (differs(mount.origin, usual.origin)) {
    text += fmt::format("origin = {}  # sensor position in the cloud's frame, metres\n",
                        numbers(mount.origin, 2));
  }
  if (mount.scale != usual.scale) {
    text += fmt::format("scale = {}  # metres per unit\n", number(mount.scale, 3));
  }
  return text;
}

}  // namespace flagstone::doctor
