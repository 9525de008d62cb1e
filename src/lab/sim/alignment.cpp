// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone::sim {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;

// The way from a point with some heading: Gauss's rule with three points, which is exact to
// rounding for the curves of roads and up to 1 m.
template <class Heading>
Vector3 way_of(double begin, double length, const Heading& heading) noexcept {
  constexpr double outer = 0.774596669241483377;
  constexpr std::array<double, 3> positions{(1 - outer) / 2, 0.5, (1 + outer) / 2};
  constexpr std::array<double, 3> weights{5.0 / 18, 8.0 / 18, 5.0 / 18};
  Vector3 way;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double yaw = heading(begin + positions[i] * length);
    way = way + weights[i] * length * Vector3{std::cos(yaw), std::sin(yaw), 0};
  }
  return way;
}

}  // namespace

// On a circuit, the heading is a steady turn plus a wave of two or three periods. Such a line
// closes by symmetry, whatever the amplitude.
Alignment::Alignment(const Extent& extent, Random random) : extent_(extent) {
  constexpr double beyond = 250;  // metres, more than any environment continues beyond its ends
  const Interval reach = extent.reach(beyond);
  first_ = reach.low;
  if (extent.closed) {
    constexpr double most_bend = 1.5;  // change of the curvature, as a fraction of its mean
    turn_ = full_turn / extent.length();
    const double room = 0.8 / (turn_ * alignment_half_width) - 1;
    const double bend = random.uniform(0.7, 1) * std::clamp(room, 0.0, most_bend);
    const double periods = random.chance(0.5) ? 2 : 3;
    bends_.push_back({.amplitude = bend / periods,
                      .wave_number = periods * turn_,
                      .phase = random.uniform(0, full_turn)});
  } else {
    constexpr double tightest = 1.0 / 300;  // of each wave, 1/m
    for (int bend = 0; bend < 2; ++bend) {
      const double wave_number = full_turn / random.uniform(350, 800);
      bends_.push_back({.amplitude = tightest * random.uniform(0.4, 1) / wave_number,
                        .wave_number = wave_number,
                        .phase = random.uniform(0, full_turn)});
    }
  }
  for (int hill = 0; hill < 3; ++hill) {
    const double wave_number = extent.fitted(full_turn / random.uniform(150, 450));
    hills_.push_back({.amplitude = random.uniform(0.005, 0.02) / wave_number,
                      .wave_number = wave_number,
                      .phase = random.uniform(0, full_turn)});
  }
  const auto count = static_cast<std::size_t>(std::lround(reach.high - reach.low)) + 1;
  Vector3 position;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = first_ + static_cast<double>(i);
    nodes_.push_back({.x = position.x, .y = position.y, .yaw = heading(x)});
    position = position + way_of(x, 1, [&](double at) { return heading(at); });
  }
  const Stop start = at(extent.begin());
  for (Stop& node : nodes_) {
    node.x -= start.x;
    node.y -= start.y;
  }
}

double Alignment::heading(double x) const noexcept {
  double yaw = turn_ * (x - extent_.begin());
  for (const Wave& bend : bends_) {
    yaw += bend.amplitude * std::sin(bend.wave_number * x + bend.phase);
  }
  return yaw;
}

Stop Alignment::at(double x) const noexcept {
  if (extent_.closed) x -= extent_.length() * std::floor((x - first_) / extent_.length());
  const auto last = static_cast<double>(nodes_.size() - 1);
  const double node = std::clamp(std::floor(x - first_), 0.0, last);
  const Stop& before = nodes_[static_cast<std::size_t>(node)];
  const double begin = first_ + node;
  const Vector3 way = way_of(begin, x - begin, [&](double at) { return heading(at); });
  return {.x = before.x + way.x, .y = before.y + way.y, .yaw = heading(x)};
}

double Alignment::height(double x) const noexcept {
  double height = 0;
  for (const Wave& hill : hills_) {
    height += hill.amplitude * std::sin(hill.wave_number * (x - extent_.begin()) + hill.phase);
  }
  return height;
}

Vector3 Alignment::to_world(Vector3 road) const noexcept {
  const Stop on_line = at(road.x);
  return {on_line.x - road.y * std::sin(on_line.yaw), on_line.y + road.y * std::cos(on_line.yaw),
          road.z + height(road.x)};
}

Stop Alignment::to_world(const Stop& road) const noexcept {
  const Vector3 place = to_world(Vector3{road.x, road.y, 0});
  return {.x = place.x, .y = place.y, .yaw = at(road.x).yaw + road.yaw};
}

}  // namespace flagstone::sim
