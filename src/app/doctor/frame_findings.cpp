// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/frame_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

#include "app/doctor/advice.hpp"

namespace flagstone::doctor {
namespace {

std::string_view axis_name(const Vector3f& axis) {
  constexpr std::array<std::string_view, 6> names{"x", "-x", "y", "-y", "z", "-z"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis[i] != 0) return names[2 * i + (axis[i] < 0 ? 1 : 0)];
  }
  return "z";
}

std::string components(const Vector3f& v, int digits) {
  return fmt::format("[{1:.{0}f}, {2:.{0}f}, {3:.{0}f}]", digits, v[0], v[1], v[2]);
}

Finding units(const Summary& summary) {
  Finding finding{.id = "units",
                  .values = {{"metres_per_unit", summary.metres}, {"reach", summary.reach}}};
  if (summary.metres == 1) {
    finding.sentence = fmt::format("Metres: 99 of 100 points lie within {:.0f}.", summary.reach);
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "99 of 100 points lie within {:.0f} units: these are {}, not metres.",
      summary.reach / summary.metres, summary.metres == 0.001 ? "millimetres" : "centimetres");
  finding.remedy = fmt::format("Set mount.scale = {}.", summary.metres);
  return finding;
}

Finding ground(const Summary& summary) {
  const std::size_t found = summary.orientation ? summary.orientation->scans : 0;
  Finding finding{.id = "ground",
                  .values = {{"scans", static_cast<double>(summary.scans)},
                             {"scans_with_ground", static_cast<double>(found)}}};
  if (found == 0) {
    finding.severity = Severity::fix;
    finding.sentence =
        fmt::format("No ground is to be seen near the sensor: {}.", to_sentence(summary.refusal));
    finding.remedy =
        "Give scans that see the ground around the vehicle; if they do, set sensor_height and "
        "mount.up by hand.";
    return finding;
  }
  finding.severity = 2 * found > summary.scans ? Severity::fine : Severity::note;
  finding.sentence = summary.scans == 1 ? "Ground is to be seen."
                                        : fmt::format("Ground is to be seen in {} of {} scans.",
                                                      found, summary.scans);
  return finding;
}

Finding axes(const CommonOrientation& orientation) {
  const std::string_view name = axis_name(orientation.axis);
  Finding finding{.id = "axes",
                  .values = {{"up_x", orientation.axis[0]},
                             {"up_y", orientation.axis[1]},
                             {"up_z", orientation.axis[2]}}};
  if (name == "z") {
    finding.sentence = "z is up.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = name == "-z" ? "z is down: the clouds are upside down."
                                  : fmt::format("Up is {}, not z.", name);
  finding.remedy =
      fmt::format("Set mount.tilt = \"fixed\" and mount.up = {}.", components(orientation.axis, 1));
  return finding;
}

/// By which turns about x and y the clouds are tilted, where z is up.
std::string angles(const CommonOrientation& orientation) {
  if (orientation.axis != Vector3f{0, 0, 1}) return {};
  constexpr double degrees = 180 / std::numbers::pi;
  const auto& [x, y, z] = orientation.up;
  return fmt::format(" ({:.1f} about x, {:.1f} about y)", std::atan2(y, z) * degrees,
                     std::atan2(-x, z) * degrees);
}

Finding tilt(const CommonOrientation& orientation, const Advice& advice) {
  Finding finding{.id = "tilt",
                  .values = {{"degrees", orientation.tilt},
                             {"up_x", orientation.up[0]},
                             {"up_y", orientation.up[1]},
                             {"up_z", orientation.up[2]}}};
  finding.sentence = fmt::format("The ground is {:.1f} degrees from level{}.", orientation.tilt,
                                 angles(orientation));
  if (!orientation.is_tilted()) return finding;
  finding.severity = Severity::fix;
  finding.remedy = fmt::format(
      "Set mount.tilt = \"fixed\" and mount.up = {}, unless the vehicle stood level before a "
      "slope.",
      components(advice.mount.up, 4));
  return finding;
}

Finding origin(const Summary& summary, const CommonOrientation& orientation, const Advice& advice) {
  const double ground = orientation.ground;
  Finding finding{.id = "origin", .values = {{"ground", ground}}};
  const std::string_view name = axis_name(orientation.axis);
  const std::string set =
      fmt::format("Set mount.origin = {} and sensor_height = {:.2f}",
                  components(advice.mount.origin, 2), advice.mount.sensor_height);
  if (summary.beam_origin) {
    finding.severity = Severity::fix;
    finding.values.emplace_back("beams", *summary.beam_origin);
    finding.sentence = fmt::format(
        "The origin is not the sensor: the ground is at {0} = {1:.2f}, and the beams come from "
        "{0} = {2:.2f}.",
        name, ground, *summary.beam_origin);
    finding.remedy = set + '.';
  } else if (ground > highest_ground) {
    finding.severity = Severity::fix;
    finding.sentence = fmt::format(
        "The origin is not the sensor: the ground is at {} = {:.2f}; how high the sensor was the "
        "points do not tell.",
        name, ground);
    finding.remedy = set + ", or what you measure.";
  } else {
    finding.sentence = "The origin can be the sensor.";
    finding.is_plain = true;
  }
  return finding;
}

Finding sensor_height(const CommonOrientation& orientation, const Expected& expected,
                      const Advice& advice) {
  const double height = advice.mount.sensor_height;
  const double scatter = orientation.highest_ground - orientation.lowest_ground;
  const double upright = std::abs(mount::dot(advice.mount.up, orientation.axis));
  const double seen = (mount::dot(advice.mount.origin, orientation.axis) - orientation.ground) *
                      std::min(upright, 1.0);
  Finding finding{
      .id = "sensor_height",
      .values = {{"seen", seen}, {"configured", expected.sensor_height}, {"scatter", scatter}}};
  constexpr double most_scatter = 0.4;  // metres
  std::string scattered;
  if (scatter > most_scatter) {
    finding.severity = Severity::note;
    scattered =
        fmt::format(" From scan to scan it differs by {:.2f} m: are they of one vehicle?", scatter);
  }
  if (advice.mount.sensor_height == expected.sensor_height) {
    finding.sentence = fmt::format("The ground lies {:.2f} m below the sensor; {:.2f} m is set.{}",
                                   seen, expected.sensor_height, scattered);
    return finding;
  }
  const double difference = std::abs(height - double{expected.sensor_height});
  finding.severity = difference > height_doubt(orientation) + harmful_height_difference
                         ? Severity::fix
                         : Severity::note;
  finding.sentence =
      fmt::format("The ground lies {:.2f} m below the sensor, but {:.2f} m is set.{}", height,
                  expected.sensor_height, scattered);
  finding.remedy = fmt::format("Set sensor_height = {:.2f}.", height);
  return finding;
}

}  // namespace

void add_frame_findings(const Summary& summary, const Expected& expected,
                        const std::optional<Advice>& advice, std::vector<Finding>& findings) {
  findings.push_back(units(summary));
  findings.push_back(ground(summary));
  if (!advice || !summary.orientation) return;
  const CommonOrientation& orientation = *summary.orientation;
  findings.push_back(axes(orientation));
  findings.push_back(tilt(orientation, *advice));
  findings.push_back(origin(summary, orientation, *advice));
  findings.push_back(sensor_height(orientation, expected, *advice));
}

}  // namespace flagstone::doctor
