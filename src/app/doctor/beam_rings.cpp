// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/beam_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

namespace flagstone::doctor {
namespace {

constexpr double half_turn = 180;

double azimuth_of(const Vector3f& p) {
  return std::atan2(double{p[1]}, double{p[0]}) * half_turn / std::numbers::pi;
}

/// -180 to 180.
double turned(double from, double to) {
  const double step = to - from;
  return step > half_turn ? step - 360 : step < -half_turn ? step + 360 : step;
}

BeamRings rings_of_field(std::span<const int> field) {
  BeamRings rings{.source = RingSource::field, .of_points = {field.begin(), field.end()}};
  std::map<int, int> numbers;
  for (const int ring : field) numbers.emplace(ring, 0);
  for (auto& [ring, number] : numbers) number = rings.count++;
  for (int& ring : rings.of_points) ring = numbers[ring];
  return rings;
}

constexpr double steady_step = 5;  // degrees from point to point, with gaps

/// The way points turn that are listed ring after ring: 1 counter-clockwise, -1 clockwise, 0 where
/// they are listed otherwise.
double way_of(const std::vector<double>& azimuths) {
  constexpr double steady_share = 0.9;
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double step = turned(azimuths[i - 1], azimuths[i]);
    if (std::abs(step) <= steady_step) ++(step > 0 ? left : right);
  }
  const auto steady = static_cast<double>(std::max(left, right));
  if (steady < steady_share * static_cast<double>(azimuths.size())) return 0;
  return left > right ? 1 : -1;
}

/// Numbers the rings, each of which begins at azimuth `start`, give or take a little, and turns
/// `way`.
BeamRings cut_at(double start, double way, const std::vector<double>& azimuths) {
  constexpr double slack = 2;  // degrees
  std::vector<double> since(azimuths.size());
  for (std::size_t i = 0; i < azimuths.size(); ++i) {
    const double angle = way * (azimuths[i] - start) + slack;
    since[i] = angle - 360 * std::floor(angle / 360);
  }
  const double far_back = std::ranges::max(since) / 2;
  BeamRings rings{.source = RingSource::order, .of_points = std::vector<int>(azimuths.size())};
  int ring = 0;
  std::size_t begin = 0;  // of the last ring
  for (std::size_t i = 1; i < since.size(); ++i) {
    const double step = since[i] - since[i - 1];
    const bool is_close = std::abs(turned(azimuths[i - 1], azimuths[i])) <= steady_step;
    if (step < -far_back) ++ring;
    if (step > far_back && is_close) --ring;  // but a point out of order where rings meet
    ring = std::max(ring, 0);
    rings.of_points[i] = ring;
    if (ring >= rings.count) begin = i;
    rings.count = std::max(rings.count, ring + 1);
  }
  // The very end of the last ring lies beyond the place where the next would begin.
  const bool is_stub = *std::max_element(since.begin() + static_cast<std::ptrdiff_t>(begin),
                                         since.end()) < 2 * slack;
  if (is_stub && rings.count > 1) {
    --rings.count;
    for (int& number : rings.of_points) number = std::min(number, rings.count - 1);
  }
  return rings;
}

/// How much elevations differ from point to point of one ring, degrees: the mean.
double raggedness(std::span<const Vector3f> places, const BeamRings& rings) {
  std::vector<double> sums(static_cast<std::size_t>(rings.count));
  std::vector<double> counts(sums.size());
  std::vector<double> elevations(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [x, y, z] = places[i];
    elevations[i] = std::atan2(double{z}, std::hypot(double{x}, double{y}));
    const auto ring = static_cast<std::size_t>(rings.of_points[i]);
    sums[ring] += elevations[i];
    ++counts[ring];
  }
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto ring = static_cast<std::size_t>(rings.of_points[i]);
    sum += std::abs(elevations[i] - sums[ring] / counts[ring]);
  }
  return sum / static_cast<double>(places.size());
}

/// Where nothing is seen ends, if that is a good part of the circle: a narrow view begins there.
std::vector<double> begin_of_view(std::vector<double> azimuths, double way) {
  constexpr double narrow = 45;
  std::ranges::sort(azimuths);
  double widest = 360 - (azimuths.back() - azimuths.front());
  double begin = way > 0 ? azimuths.front() : azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    if (azimuths[i] - azimuths[i - 1] <= widest) continue;
    widest = azimuths[i] - azimuths[i - 1];
    begin = way > 0 ? azimuths[i] : azimuths[i - 1];
  }
  if (widest < narrow) return {};
  return {begin};
}

/// Where rings begin nobody says: of several places, the one that makes them the most even.
BeamRings rings_of_order(std::span<const Vector3f> places) {
  constexpr int fewest_rings = 4;
  constexpr int most_rings = 512;
  if (places.empty()) return {};
  std::vector<double> azimuths(places.size());
  std::ranges::transform(places, azimuths.begin(), azimuth_of);
  const double way = way_of(azimuths);
  if (way == 0) return {};
  std::vector<double> starts = begin_of_view(azimuths, way);
  starts.insert(starts.end(), {azimuths.front(), 0, half_turn});
  BeamRings best;
  double least = 0;
  for (const double start : starts) {
    BeamRings rings = cut_at(start, way, azimuths);
    if (rings.count < fewest_rings || rings.count > most_rings) continue;
    const double ragged = raggedness(places, rings);
    if (best.count > 0 && ragged >= least) continue;
    best = std::move(rings);
    least = ragged;
  }
  return best;
}

}  // namespace

BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field) {
  return field.empty() ? rings_of_order(places) : rings_of_field(field);
}

}  // namespace flagstone::doctor
