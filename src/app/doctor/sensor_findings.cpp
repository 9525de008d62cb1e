// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/sensor_findings.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flagstone::doctor {
namespace {

Finding ego_vehicle(const Summary& summary) {
  const OwnVehicle& vehicle = summary.vehicle;
  Finding finding{.id = "ego_vehicle",
                  .values = {{"share", vehicle.share}, {"roof", vehicle.roof}}};
  constexpr double hardly_any = 0.005;
  if (vehicle.share < hardly_any) {
    finding.sentence = "Hardly a point lies on the own vehicle.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence = fmt::format(
      "{:.1f} % of the points stand over the ground within 2.7 m of the sensor{}: the own vehicle.",
      100 * vehicle.share,
      vehicle.roof > 0 ? fmt::format(", most of them {:.1f} m high", vehicle.roof) : "");
  finding.remedy = "Nothing to set: the ground is not looked for there.";
  return finding;
}

Finding beams(const Summary& summary) {
  Finding finding{.id = "beams", .values = {{"beams", static_cast<double>(summary.view.beams)}}};
  if (summary.is_voxel_averaged || summary.view.beams == 0) {
    finding.sentence = "No beams are to be told apart.";
    // A narrow view without beams is a rosette's; what a voxel grid did to them is said elsewhere.
    if (!summary.view.sees_all_around() || summary.is_voxel_averaged) return finding;
    finding.severity = Severity::note;
    finding.remedy = "Nothing to set: surface and patchwork need none; cascaded guesses them.";
    return finding;
  }
  const auto source = [&] {
    switch (summary.rings) {
      case RingSource::field: return "by the field ring";
      case RingSource::order: return "by the order of the points";
      case RingSource::none: break;
    }
    return "by their elevations";
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
          : fmt::format("{:.0f} degrees wide, from {:.0f} to {:.0f}", view.azimuth_width,
                        view.azimuth_begin, view.azimuth_begin + view.azimuth_width);
  finding.sentence = fmt::format("Points from {:+.1f} to {:+.1f} degrees of elevation, {}.",
                                 view.bottom, view.top, azimuths);
  return finding;
}

Finding range(const Summary& summary, const Expected& expected) {
  Finding finding{.id = "range",
                  .values = {{"reach", summary.reach}, {"farthest", summary.farthest}}};
  finding.sentence = fmt::format("99 of 100 points lie within {:.0f} m, the farthest at {:.0f} m.",
                                 summary.reach, summary.farthest);
  if (!expected.max_range || summary.reach <= double{*expected.max_range}) return finding;
  finding.severity = Severity::note;
  finding.remedy = fmt::format(
      "Beyond max_range = {:g} m every point is labelled out_of_range; set max_range = {:.0f} if "
      "they matter.",
      *expected.max_range, std::min(std::ceil(summary.reach / 10) * 10, 200.0));
  return finding;
}

Finding downsampling(const Summary& summary) {
  Finding finding{.id = "downsampling", .values = {{"growth", summary.growth}}};
  if (!summary.is_voxel_averaged) {
    finding.sentence = "As dense as the sensor made it.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence =
      "Near things have no more points than far ones: the cloud is thinned out, most likely to one "
      "point a voxel.";
  finding.remedy = "Nothing to set; scans as the sensor made them give better labels.";
  return finding;
}

Finding sensor(const std::vector<const Sensor*>& sensors) {
  Finding finding{.id = "sensor", .values = {{"matches", static_cast<double>(sensors.size())}}};
  if (sensors.empty()) {
    finding.sentence = "No sensor that is known by name looks like this.";
    finding.remedy = "Nothing to set; a file of your own can describe it: docs/sensors.md.";
    return finding;
  }
  finding.sentence =
      fmt::format("It looks like {}, {}", sensors.front()->name, sensors.front()->title);
  for (std::size_t i = 1; i < sensors.size(); ++i) {
    finding.sentence += fmt::format("{}{}", i == 1 ? "; or like " : ", ", sensors[i]->name);
  }
  finding.sentence += '.';
  finding.remedy = fmt::format("Set sensor = \"{}\".", sensors.front()->name);
  return finding;
}

}  // namespace

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

}  // namespace flagstone::doctor
