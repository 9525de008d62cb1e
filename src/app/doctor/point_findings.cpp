// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/point_findings.hpp"

#include <fmt/format.h>

#include <cmath>

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
    finding.sentence = fmt::format("{:.0f} points a scan, {:.0f} of them with a place.",
                                   summary.points, summary.usable);
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "{:.0f} points a scan, {:.0f} of them with a place: too few to tell anything (1000 are "
      "needed).",
      summary.points, summary.usable);
  finding.remedy = "Give whole scans; for .bin files see whether --columns is right.";
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
      fmt::format("{} of the points are (0, 0, 0): no echo came back.", percent(summary.zero));
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
    finding.sentence = "Hardly a point occurs twice.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::note;
  finding.sentence = fmt::format("{} of the points repeat the coordinates of another one.",
                                 percent(summary.repeated));
  finding.remedy =
      "Nothing to set; if the driver reports two echoes a beam, or scans were put together, they "
      "count twice: drop them.";
  return finding;
}

Finding coordinates(const Summary& summary) {
  const double x = summary.middle[0];
  const double y = summary.middle[1];
  Finding finding{.id = "coordinates",
                  .values = {{"middle_x", x}, {"middle_y", y}, {"away", std::hypot(x, y)}}};
  if (!summary.is_far_away) {
    finding.sentence = "The origin lies among the points.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence = fmt::format(
      "The points lie around ({:.0f}, {:.0f}), far from the origin: coordinates of a map, not of a "
      "sensor.",
      x, y);
  finding.remedy =
      "Write the scans in the sensor's frame: subtract where the sensor was, before the "
      "coordinates "
      "become 32-bit floats.";
  return finding;
}

Finding single_viewpoint(const Summary& summary) {
  Finding finding{.id = "single_viewpoint"};
  if (!summary.is_from_many_places) {
    finding.sentence = "The points thin out with distance as seen from one place.";
    finding.is_plain = true;
    return finding;
  }
  finding.severity = Severity::fix;
  finding.sentence =
      "The points lie as densely far out as in the middle: they were not seen from one place, but "
      "from the air or from a drive.";
  finding.remedy =
      "flagstone segments scans of one sensor from one place; give it these one by one, before "
      "they "
      "are put together.";
  return finding;
}

}  // namespace

void add_point_findings(const Summary& summary, std::vector<Finding>& findings) {
  findings.push_back(points(summary));
  findings.push_back(zero_returns(summary));
  findings.push_back(not_finite(summary));
  findings.push_back(duplicate_points(summary));
  if (!summary.has_enough_points) return;
  findings.push_back(coordinates(summary));
  findings.push_back(single_viewpoint(summary));
}

}  // namespace flagstone::doctor
