// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "doctor/beam_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>

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

/// Points that are listed ring after ring turn steadily one way, and jump back at the end of a ring
/// if the sensor does not see all around. A ring begins where the first point is, give or take
/// `slack`.
BeamRings rings_of_order(std::span<const Vector3f> places) {
  constexpr double slack = 2;        // degrees
  constexpr double steady_step = 5;  // degrees, with gaps
  constexpr double steady_share = 0.9;
  constexpr int fewest_rings = 4;
  constexpr int most_rings = 512;

  std::vector<double> azimuths(places.size());
  std::ranges::transform(places, azimuths.begin(), azimuth_of);
  std::size_t left = 0;
  std::size_t right = 0;
  for (std::size_t i = 1; i < azimuths.size(); ++i) {
    const double step = turned(azimuths[i - 1], azimuths[i]);
    if (std::abs(step) > steady_step) continue;
    ++(step > 0 ? left : right);
  }
  const double way = left > right ? 1 : -1;
  if (static_cast<double>(std::max(left, right)) <
      steady_share * static_cast<double>(places.size())) {
    return {};
  }

  // Degrees turned since a little before the first point, the way they turn.
  std::vector<double> since(places.size());
  double widest = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    double angle = way * (azimuths[i] - azimuths[0]) + slack;
    angle -= 360 * std::floor(angle / 360);
    since[i] = angle;
    widest = std::max(widest, angle);
  }
  BeamRings rings{.source = RingSource::order, .of_points = std::vector<int>(places.size())};
  int ring = 0;
  for (std::size_t i = 1; i < since.size(); ++i) {
    const double step = since[i] - since[i - 1];
    if (step < -widest / 2) ++ring;
    if (step > widest / 2) --ring;  // it was but a point out of order
    rings.of_points[i] = std::max(ring, 0);
  }
  rings.count = ring + 1;
  for (int& number : rings.of_points) number = std::clamp(number, 0, std::max(ring, 0));
  if (rings.count < fewest_rings || rings.count > most_rings) return {};
  return rings;
}

}  // namespace

BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field) {
  return field.empty() ? rings_of_order(places) : rings_of_field(field);
}

}  // namespace flagstone::doctor
