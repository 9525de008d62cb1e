// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/field_of_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Sees to it that stray points count as no direction that is looked at.
constexpr double least_share = 0.02;

void find_azimuths(const std::array<std::size_t, 360>& counts, std::size_t points,
                   FieldOfView& view) {
  constexpr int widest_shadow = 45;  // of something close by, degrees
  const double least = least_share * static_cast<double>(points) / 360;
  int longest = 0;
  int run = 0;
  int end = 0;  // of the longest gap
  for (int i = 0; i < 720; ++i) {
    const bool is_empty = static_cast<double>(counts[static_cast<std::size_t>(i % 360)]) <= least;
    run = is_empty ? run + 1 : 0;
    if (run > longest && run <= 360) {
      longest = run;
      end = i + 1;
    }
  }
  const bool all_around = longest <= widest_shadow;
  view.azimuth_begin = all_around ? -180 : end % 360 - 180;
  view.azimuth_width = all_around ? 360 : 360 - longest;
}

/// Each beam's middle elevation tells more than the points, which stray.
void find_edges_by_ring(std::vector<std::vector<double>>& elevations, FieldOfView& view) {
  constexpr std::size_t fewest = 10;
  view.top = -90;
  view.bottom = 90;
  for (std::vector<double>& ring : elevations) {
    if (ring.size() < fewest) continue;
    const double middle = percentile(ring, 50);
    view.top = std::max(view.top, middle);
    view.bottom = std::min(view.bottom, middle);
  }
}

/// Beams at the same elevations all around: a comb of elevations, its teeth counted; 0 without one.
int count_beams(const std::vector<double>& elevations) {
  constexpr double step = 0.1;  // degrees
  constexpr std::size_t steps = 1800;
  constexpr std::size_t reach = 5;  // on both sides
  constexpr double share_in_teeth = 0.8;
  std::vector<double> counts(steps);
  for (const double elevation : elevations) {
    ++counts[std::min(static_cast<std::size_t>((elevation + 90) / step), steps - 1)];
  }
  const double least = static_cast<double>(elevations.size()) * 1e-4;
  double in_teeth = 0;
  std::size_t wide = 0;   // teeth, in steps
  std::size_t first = 0;  // step of the lowest tooth
  std::size_t last = 0;
  int teeth = 0;
  for (std::size_t i = reach; i + reach < steps; ++i) {
    double around = 0;
    for (std::size_t k = i - reach; k <= i + reach; ++k) around += counts[k] / (2 * reach + 1);
    const auto is_tooth = [&](std::size_t k) { return counts[k] > least && counts[k] > around; };
    if (!is_tooth(i)) continue;
    in_teeth += counts[i];
    if (wide++ == 0) first = i;
    last = i;
    if (counts[i] >= counts[i - 1] && counts[i] > counts[i + 1]) ++teeth;
  }
  const bool is_comb = in_teeth > share_in_teeth * static_cast<double>(elevations.size()) &&
                       2 * wide < last - first + 1;
  constexpr int fewest = 4;
  return is_comb && teeth >= fewest ? teeth : 0;
}

}  // namespace

FieldOfView find_field_of_view(std::span<const Vector3f> places, const BeamRings& rings,
                               double nearest) {
  FieldOfView view{.beams = rings.count};
  std::array<std::size_t, 360> azimuths{};
  std::vector<double> elevations;
  std::vector<std::vector<double>> by_ring(static_cast<std::size_t>(rings.count));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::array<double, 3> p{places[i][0], places[i][1], places[i][2]};
    if (std::hypot(p[0], p[1], p[2]) < nearest) continue;
    const double elevation = std::atan2(p[2], std::hypot(p[0], p[1])) * degrees;
    const double azimuth = std::atan2(p[1], p[0]) * degrees + 180;
    ++azimuths[std::min(static_cast<std::size_t>(azimuth), azimuths.size() - 1)];
    elevations.push_back(elevation);
    if (rings.count > 0) by_ring[static_cast<std::size_t>(rings.of_points[i])].push_back(elevation);
  }
  if (elevations.empty()) return view;
  find_azimuths(azimuths, elevations.size(), view);
  if (rings.count > 0) {
    find_edges_by_ring(by_ring, view);
  } else {
    view.beams = count_beams(elevations);
    view.top = percentile(elevations, 99.8);
    view.bottom = percentile(elevations, 0.2);
  }
  return view;
}

}  // namespace flagstone::doctor
