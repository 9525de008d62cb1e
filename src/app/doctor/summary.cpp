// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

using Scans = std::vector<const Examination*>;

template <class Value>
double median(const Scans& scans, Value value) {
  std::vector<double> values;
  for (const Examination* scan : scans) values.push_back(static_cast<double>(value(*scan)));
  return flagstone::median(values);
}

template <class Holds>
bool most(const Scans& scans, Holds holds) {
  const auto count = std::ranges::count_if(scans, [&](const auto* scan) { return holds(*scan); });
  return 2 * static_cast<std::size_t>(count) > scans.size();
}

/// The value that most scans have.
template <class Value>
auto most_common(const Scans& scans, Value value) {
  const auto votes = [&](const Examination* of) {
    return std::ranges::count_if(
        scans, [&](const Examination* scan) { return value(*scan) == value(*of); });
  };
  return value(**std::ranges::max_element(scans, {}, votes));
}

Scans enough_points(std::span<const Examination> all) {
  Scans scans;
  for (const Examination& scan : all) {
    if (scan.has_enough_points()) scans.push_back(&scan);
  }
  return scans;
}

void count_points(std::span<const Examination> scans, Summary& summary) {
  std::vector<double> points;
  std::vector<double> usable;
  double all = 0;
  double all_usable = 0;
  for (const Examination& scan : scans) {
    points.push_back(static_cast<double>(scan.points));
    usable.push_back(static_cast<double>(scan.usable()));
    all += points.back();
    all_usable += usable.back();
    summary.zero += static_cast<double>(scan.zero);
    summary.not_finite += static_cast<double>(scan.not_finite);
    summary.repeated += static_cast<double>(scan.repeated);
  }
  summary.points = flagstone::median(points);
  summary.usable = flagstone::median(usable);
  summary.zero /= std::max(all, 1.0);
  summary.not_finite /= std::max(all, 1.0);
  summary.repeated /= std::max(all_usable, 1.0);
}

/// Orientation of the scans with ground and with the most common axis; removes the other scans.
CommonOrientation common_orientation(Scans& scans) {
  CommonOrientation common;
  common.axis = most_common(scans, [](const Examination& scan) { return scan.orientation.axis; });
  std::erase_if(scans, [&](const auto* scan) { return scan->orientation.axis != common.axis; });
  common.scans = scans.size();
  Vector3f up{};
  for (const Examination* scan : scans) {
    for (std::size_t i = 0; i < 3; ++i) up[i] += scan->orientation.decision.mount.up[i];
  }
  common.up = mount::unit(up);
  const double cosine = std::clamp(double{mount::dot(common.up, common.axis)}, -1.0, 1.0);
  common.tilt = std::acos(cosine) * 180 / std::numbers::pi;
  const auto ground = [&](const Examination& scan) {
    return double{common.is_tilted() ? scan.orientation.ground_of_tilt()
                                     : scan.orientation.ground_of_axis()};
  };
  common.ground = median(scans, ground);
  const auto [low, high] = std::ranges::minmax_element(
      scans, {}, [&](const Examination* scan) { return ground(*scan); });
  common.lowest_ground = ground(**low);
  common.highest_ground = ground(**high);
  return common;
}

void summarise_orientation(Scans scans, Summary& summary) {
  summary.refusal = scans.front()->orientation.decision;
  std::erase_if(scans, [](const auto* scan) { return !scan->orientation.is_found(); });
  if (scans.empty()) return;
  summary.orientation = common_orientation(scans);
  summary.shows_beam_origin =
      most(scans, [](const Examination& scan) { return scan.origin.has_value(); });
  const auto is_elsewhere = [](const Examination& scan) {
    return scan.origin.has_value() && scan.origin->is_elsewhere();
  };
  if (most(scans, is_elsewhere)) {
    Scans elsewhere = scans;
    std::erase_if(elsewhere, [&](const Examination* scan) { return !is_elsewhere(*scan); });
    summary.beam_origin.emplace();
    for (std::size_t i = 0; i < 3; ++i) {
      (*summary.beam_origin)[i] = static_cast<float>(
          median(elsewhere, [i](const Examination& scan) { return scan.origin->place[i]; }));
    }
  }
  summary.vehicle.share = median(scans, [](const Examination& s) { return s.vehicle.share; });
  summary.vehicle.roof = median(scans, [](const Examination& s) { return s.vehicle.roof; });
}

void summarise_view(const Scans& scans, Summary& summary) {
  using Scan = const Examination&;
  summary.rings = most_common(scans, [](Scan scan) { return scan.rings; });
  summary.view.beams = most_common(scans, [](Scan scan) { return scan.view.beams; });
  summary.view.top = median(scans, [](Scan scan) { return scan.view.top; });
  summary.view.bottom = median(scans, [](Scan scan) { return scan.view.bottom; });
  summary.view.azimuth_begin = median(scans, [](Scan scan) { return scan.view.azimuth_begin; });
  summary.view.azimuth_width = median(scans, [](Scan scan) { return scan.view.azimuth_width; });
}

}  // namespace

Summary summarise(std::span<const Examination> all) {
  Summary summary{.scans = all.size()};
  count_points(all, summary);
  const Scans scans = enough_points(all);
  summary.has_enough_points = 2 * scans.size() > all.size();
  if (!summary.has_enough_points) return summary;

  using Scan = const Examination&;
  summary.metres = most_common(scans, [](Scan scan) { return scan.extent.metres; });
  summary.middle = scans.front()->extent.middle;
  summary.is_far_away = most(scans, [](Scan scan) { return scan.extent.is_far_away(); });
  summary.is_from_many_places =
      most(scans, [](Scan scan) { return scan.downsampling.is_from_many_places(); });
  summary.reach = summary.metres * median(scans, [](Scan scan) { return scan.extent.reach; });
  summary.farthest = summary.metres * median(scans, [](Scan s) { return s.extent.farthest; });
  if (!summary.is_scan()) return summary;
  summarise_orientation(scans, summary);
  summarise_view(scans, summary);
  summary.growth = median(scans, [](Scan scan) { return scan.downsampling.growth; });
  summary.is_voxel_averaged = Downsampling{.growth = summary.growth}.is_voxel_averaged();
  return summary;
}

}  // namespace flagstone::doctor
