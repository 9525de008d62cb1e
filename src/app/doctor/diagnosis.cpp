// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/diagnosis.hpp"

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

std::string percent(double share) {
  return share > 0 && share < 0.001 ? "less than 0.1 %" : fmt::format("{:.1f} %", 100 * share);
}

Finding points(const Summary& summary) {
  Finding finding{.id = "points",
                  .values = {{"scans", static_cast<double>(summary.scans)},
                             {"points", summary.points},
                             {"usable", summary.usable}}};
  if (summary.has_enough_points) {
    finding.sentence = fmt::format("{:.0f} points per scan, {:.0f} of them valid.", summary.points,
                                   summary.usable);
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "{:.0f} points per scan, {:.0f} of them valid: too few to examine (expected at least 1000).",
      summary.points, summary.usable);
  finding.remedy = "Use complete scans. For .bin files, check the number of columns.";
  return finding;
}

Finding zero_returns(const Summary& summary) {
  Finding finding{.id = "zero_returns", .values = {{"share", summary.zero}}};
  if (summary.zero == 0) {
    finding.sentence = "No point is (0, 0, 0).";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = summary.zero > 0.001 ? Severity::note : Severity::fine;
  finding.sentence =
      fmt::format("{} of the points are (0, 0, 0): missing returns.", percent(summary.zero));
  finding.remedy = "Nothing to set: they are labelled invalid.";
  return finding;
}

Finding not_finite(const Summary& summary) {
  Finding finding{.id = "not_finite", .values = {{"share", summary.not_finite}}};
  if (summary.not_finite == 0) {
    finding.sentence = "Every coordinate is finite.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = summary.not_finite > 0.001 ? Severity::note : Severity::fine;
  finding.sentence = fmt::format("{} of the points have a coordinate that is NaN or infinite.",
                                 percent(summary.not_finite));
  finding.remedy = "Nothing to set: they are labelled invalid.";
  return finding;
}

Finding duplicate_points(const Summary& summary) {
  Finding finding{.id = "duplicate_points", .values = {{"share", summary.repeated}}};
  if (summary.repeated < 0.01) {
    finding.sentence = "Almost no point occurs twice.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence = fmt::format("{} of the points have the coordinates of another point.",
                                 percent(summary.repeated));
  finding.remedy =
      "Nothing to set. If the driver reports two returns per beam, or if scans were merged, remove "
      "the duplicates.";
  return finding;
}

Finding coordinates(const Summary& summary) {
  const double x = summary.middle[0];
  const double y = summary.middle[1];
  Finding finding{.id = "coordinates",
                  .values = {{"middle_x", x}, {"middle_y", y}, {"away", std::hypot(x, y)}}};
  if (!summary.is_far_away) {
    finding.sentence = "The origin is among the points.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "The points are around ({:.0f}, {:.0f}), far from the origin: these are map coordinates, not "
      "sensor coordinates.",
      x, y);
  finding.remedy =
      "Write the scans in the sensor frame: subtract the position of the sensor before you convert "
      "the coordinates to 32-bit floats.";
  return finding;
}

Finding single_viewpoint(const Summary& summary) {
  Finding finding{.id = "single_viewpoint"};
  if (!summary.is_from_many_places) {
    finding.sentence = "The point density decreases with distance, as in a scan from one position.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence =
      "The points are as dense far out as in the middle: they were not recorded from one position, "
      "but from the air or while driving.";
  finding.remedy =
      "flagstone segments scans of one sensor from one position. Use the single scans, before they "
      "are merged.";
  return finding;
}

void add_point_findings(const Summary& summary, std::vector<Finding>& findings) {
  findings.push_back(points(summary));
  findings.push_back(zero_returns(summary));
  findings.push_back(not_finite(summary));
  findings.push_back(duplicate_points(summary));
  if (!summary.has_enough_points) return;
  findings.push_back(coordinates(summary));
  findings.push_back(single_viewpoint(summary));
}

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
    finding.sentence =
        fmt::format("The unit is metres: 99 % of the points are within {:.0f} m.", summary.reach);
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "99 % of the points are within {:.0f} units: the unit is {}, not metres.",
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
        fmt::format("No ground was found near the sensor: {}.", to_sentence(summary.refusal));
    finding.remedy =
        "Use scans that show the ground around the vehicle. If these do, set sensor_height and "
        "mount.up yourself.";
    return finding;
  }
  finding.severity = 2 * found > summary.scans ? Severity::fine : Severity::note;
  finding.sentence = summary.scans == 1
                         ? "Ground was found."
                         : fmt::format("Ground was found in {} of {} scans.", found, summary.scans);
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

/// The projection of `v` onto an axis.
Vector3f along(const Vector3f& axis, const Vector3f& v) {
  const float part = mount::dot(v, axis);
  return {part * axis[0], part * axis[1], part * axis[2]};
}

/// The rotations about x and y that tilt the clouds; empty if z is not up.
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
  finding.sentence = fmt::format("The ground is tilted by {:.1f} degrees{}.", orientation.tilt,
                                 angles(orientation));
  if (!orientation.is_tilted()) return finding;
  finding.severity = Severity::fix;
  finding.remedy = fmt::format(
      "Set mount.tilt = \"fixed\" and mount.up = {}, unless the vehicle was level in front of a "
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
    const Vector3f& beams = *summary.beam_origin;
    finding.values.emplace_back("beams", beams[2]);
    const bool is_across = advice.mount.origin != along(orientation.axis, advice.mount.origin);
    finding.sentence = fmt::format(
        "The origin is not the sensor: the ground is at {0} = {1:.2f}, and the beams come from "
        "{0} = {2:.2f}{3}.",
        name, ground, beams[2],
        is_across ? fmt::format(", {:.1f} m off its axis", std::hypot(beams[0], beams[1])) : "");
    finding.remedy = set + '.';
    if (beams[2] - mount::dot(advice.mount.origin, orientation.axis) > 0.05F) {
      finding.remedy += " The beams of an HDL-64E meet about 0.2 m above the origin of its frame.";
    }
  } else if (ground > highest_ground) {
    finding.severity = Severity::fix;
    finding.sentence = fmt::format(
        "The origin is not the sensor: the ground is at {} = {:.2f}. The points do not show how "
        "high "
        "the sensor is.",
        name, ground);
    finding.remedy = set + ", or your measured values.";
  } else if (ground > ground_below_an_axle && !summary.shows_beam_origin) {
    finding.severity = Severity::note;
    finding.sentence = fmt::format(
        "The ground is only {:.2f} m below the origin, as if the origin were an axle. The points "
        "do "
        "not show where the beams come from.",
        -ground);
    finding.remedy =
        "If the sensor is higher, set mount.origin to its position and sensor_height to its height "
        "above the ground.";
  } else {
    finding.sentence = "The origin is plausible for a sensor.";
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
    scattered = fmt::format(
        " The height varies by {:.2f} m between scans: are they from one vehicle?", scatter);
  }
  if (advice.mount.sensor_height == expected.sensor_height) {
    finding.sentence = fmt::format("The ground is {:.2f} m below the sensor; {:.2f} m is set.{}",
                                   seen, expected.sensor_height, scattered);
    return finding;
  }
  const double difference = std::abs(height - double{expected.sensor_height});
  finding.severity = difference > height_doubt(orientation) + harmful_height_difference
                         ? Severity::fix
                         : Severity::note;
  finding.sentence = fmt::format("The ground is {:.2f} m below the sensor, but {:.2f} m is set.{}",
                                 height, expected.sensor_height, scattered);
  finding.remedy = fmt::format("Set sensor_height = {:.2f}.", height);
  return finding;
}

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

Finding ego_vehicle(const Summary& summary) {
  const EgoVehicle& vehicle = summary.vehicle;
  Finding finding{.id = "ego_vehicle",
                  .values = {{"share", vehicle.share}, {"roof", vehicle.roof}}};
  constexpr double hardly_any = 0.005;
  if (vehicle.share < hardly_any) {
    finding.sentence = "Almost no point is on the ego vehicle.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence = fmt::format(
      "{:.1f} % of the points are above the ground and within 2.7 m of the sensor{}: they belong "
      "to "
      "the ego vehicle.",
      100 * vehicle.share,
      vehicle.roof > 0 ? fmt::format(", most of them {:.1f} m high", vehicle.roof) : "");
  finding.remedy = "Nothing to set: the ground is not estimated from these points.";
  return finding;
}

Finding beams(const Summary& summary) {
  Finding finding{.id = "beams", .values = {{"beams", static_cast<double>(summary.view.beams)}}};
  if (summary.is_voxel_averaged || summary.view.beams == 0) {
    finding.sentence = "No separate beams were found.";
    // A narrow view without beams is normal for a rosette; `downsampling` reports voxel grids.
    if (!summary.view.sees_all_around() || summary.is_voxel_averaged) return finding;
    finding.severity = Severity::note;
    finding.remedy =
        "Nothing to set: surface and patchwork do not need beams; cascaded estimates them.";
    return finding;
  }
  const auto source = [&] {
    switch (summary.rings) {
      case RingSource::field: return "from the field ring";
      case RingSource::order: return "from the order of the points";
      case RingSource::none: break;
    }
    return "from their elevations";
  };
  finding.sentence = fmt::format("{} beams, {}.", summary.view.beams, source());
  return finding;
}

Finding field_of_view(const FieldOfView& view) {
  Finding finding{.id = "field_of_view",
                  .values = {{"top", view.top},
                             {"bottom", view.bottom},
                             {"azimuth_begin", view.azimuth_begin},
                             {"azimuth_width", view.azimuth_width}}};
  const std::string azimuths =
      view.sees_all_around()
          ? "all around"
          : fmt::format("{:.0f} degrees of azimuth, from {:.0f} to {:.0f}", view.azimuth_width,
                        view.azimuth_begin, view.azimuth_begin + view.azimuth_width);
  finding.sentence =
      fmt::format("{:+.1f} to {:+.1f} degrees of elevation, {}.", view.bottom, view.top, azimuths);
  return finding;
}

Finding range(const Summary& summary, const Expected& expected) {
  Finding finding{.id = "range",
                  .values = {{"reach", summary.reach}, {"farthest", summary.farthest}}};
  finding.sentence =
      fmt::format("99 % of the points are within {:.0f} m; the farthest is at {:.0f} m.",
                  summary.reach, summary.farthest);
  if (!expected.max_range || summary.reach <= double{*expected.max_range}) return finding;
  finding.severity = Severity::note;
  finding.remedy = fmt::format(
      "Points beyond max_range = {:g} m are labelled out_of_range. Set max_range = {:.0f} if you "
      "need them.",
      *expected.max_range, std::min(std::ceil(summary.reach / 10) * 10, 200.0));
  return finding;
}

Finding downsampling(const Summary& summary) {
  Finding finding{.id = "downsampling", .values = {{"growth", summary.growth}}};
  if (!summary.is_voxel_averaged) {
    finding.sentence = "The cloud has the full density of the sensor.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence =
      "Near objects have no more points than far ones: the cloud was downsampled, probably to one "
      "point per voxel.";
  finding.remedy = "Nothing to set. Scans with the full density of the sensor give better labels.";
  return finding;
}

Finding sensor(const std::vector<const Sensor*>& sensors) {
  Finding finding{.id = "sensor", .values = {{"matches", static_cast<double>(sensors.size())}}};
  if (sensors.empty()) {
    finding.sentence = "No known sensor matches these scans.";
    finding.remedy =
        "Nothing to set. To describe your sensor in a file, see docs/reference/sensors.md.";
    return finding;
  }
  finding.sentence =
      fmt::format("The scans match {}, {}", sensors.front()->name, sensors.front()->title);
  for (std::size_t i = 1; i < sensors.size(); ++i) {
    finding.sentence += fmt::format("{}{}", i == 1 ? "; also " : ", ", sensors[i]->name);
  }
  finding.sentence += '.';
  finding.remedy = fmt::format("Set sensor = \"{}\".", sensors.front()->name);
  return finding;
}

void add_sensor_findings(const Summary& summary, const Expected& expected,
                         const std::vector<const Sensor*>& sensors,
                         std::vector<Finding>& findings) {
  if (summary.orientation) findings.push_back(ego_vehicle(summary));
  findings.push_back(beams(summary));
  findings.push_back(field_of_view(summary.view));
  findings.push_back(range(summary, expected));
  findings.push_back(downsampling(summary));
  findings.push_back(sensor(sensors));
}

}  // namespace

const char* to_string(Severity severity) noexcept {
  switch (severity) {
    case Severity::fine: return "fine";
    case Severity::note: return "note";
    case Severity::fix: return "fix";
  }
  return "unknown";
}

bool Diagnosis::has_something_to_fix() const {
  return std::ranges::any_of(findings,
                             [](const Finding& f) { return f.severity == Severity::fix; });
}

Diagnosis diagnose(const Summary& summary, const Expected& expected) {
  Diagnosis diagnosis;
  add_point_findings(summary, diagnosis.findings);
  if (!summary.is_scan()) return diagnosis;
  const std::vector<const Sensor*> sensors = matching_sensors(summary);
  if (summary.orientation)
    diagnosis.advice = advise(summary, *summary.orientation, expected, sensors);
  add_frame_findings(summary, expected, diagnosis.advice, diagnosis.findings);
  add_sensor_findings(summary, expected, sensors, diagnosis.findings);
  return diagnosis;
}

}  // namespace flagstone::doctor
