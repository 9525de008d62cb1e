// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/advice.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace flagstone::doctor {
namespace {

float rounded(double value, double step) {
  const double result = std::round(value / step) * step;
  return static_cast<float>(result == 0 ? 0 : result);  // no -0
}

/// A number that TOML takes for a float, at most `digits` after the point.
std::string number(float value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  while (text.ends_with('0') && !text.ends_with(".0")) text.pop_back();
  return text;
}

std::string numbers(const Vector3f& values, int digits) {
  return fmt::format("[{}, {}, {}]", number(values[0], digits), number(values[1], digits),
                     number(values[2], digits));
}

bool differs(const Vector3f& a, const Vector3f& b) { return a != b; }

}  // namespace

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

  // Along the axis, metres above the cloud's origin.
  const bool is_off_sensor = summary.beam_origin || orientation.ground > highest_ground;
  double origin = 0;
  if (is_off_sensor) {
    origin = summary.beam_origin.value_or(orientation.ground + double{expected.sensor_height});
  }
  origin = double{rounded(origin, 0.01)};
  for (std::size_t i = 0; i < 3; ++i) {
    mount.origin[i] = rounded(origin * double{orientation.axis[i]}, 0.01);
  }

  const double upright =
      orientation.is_tilted() ? double{mount::dot(orientation.up, orientation.axis)} : 1;
  const double height = (origin - orientation.ground) * upright;
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
  std::string text = "# Settings by 'flagstone doctor', for --config\n";
  if (!advice.sensor.empty()) text += fmt::format("sensor = \"{}\"\n", advice.sensor);
  text += fmt::format("sensor_height = {}  # metres above the ground\n",
                      number(mount.sensor_height, 3));
  if (!advice.has_mount) return text;
  text += "\n[mount]\n";
  if (differs(mount.up, usual.up)) {
    text += fmt::format("tilt = \"fixed\"\nup = {}  # where up is in the cloud's frame\n",
                        numbers(mount.up, 4));
  }
  if (differs(mount.origin, usual.origin)) {
    text += fmt::format("origin = {}  # where the sensor is in the cloud's frame, metres\n",
                        numbers(mount.origin, 2));
  }
  if (mount.scale != usual.scale) {
    text += fmt::format("scale = {}  # metres a unit\n", number(mount.scale, 3));
  }
  return text;
}

}  // namespace flagstone::doctor
