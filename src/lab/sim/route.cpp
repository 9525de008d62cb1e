// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/route.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone::sim {

std::vector<Stop> wander_along(const std::function<Stop(double x)>& path, Random& random,
                               const Extent& extent) {
  constexpr double along = 0.5;
  constexpr double across = 0.25;
  constexpr double turn = 2 * std::numbers::pi / 180;
  const std::size_t last = extent.stretches_of_run() * stops_per_stretch;
  std::vector<Stop> stops;
  for (std::size_t i = 0; i <= last; ++i) {
    const double x = -half_drive + static_cast<double>(i) * frame_spacing;
    Stop stop = path(x + random.uniform(-along, along));
    const double aside = random.uniform(-across, across);
    stop.x -= aside * std::sin(stop.yaw);
    stop.y += aside * std::cos(stop.yaw);
    stop.yaw += random.uniform(-turn, turn);
    stops.push_back(stop);
  }
  return stops;
}

// A cubic Hermite curve. Its tangent at a stop is as long as the distance between the two stops.
Stop between_stops(std::span<const Stop> stops, double at) noexcept {
  const auto before = std::min(static_cast<std::size_t>(std::max(at, 0.0)), stops.size() - 1);
  if (before + 1 == stops.size()) return stops.back();
  const double u = at - static_cast<double>(before);
  const Stop& one = stops[before];
  if (u <= 0) return one;  // without rounding
  const Stop& next = stops[before + 1];
  const double gap = std::hypot(next.x - one.x, next.y - one.y);
  const auto blend = [u](double begin, double end, double tangent, double end_tangent) {
    const double v = 1 - u;
    return v * v * (1 + 2 * u) * begin + u * u * (1 + 2 * v) * end +
           u * v * (v * tangent - u * end_tangent);
  };
  const auto slope = [u](double begin, double end, double tangent, double end_tangent) {
    const double v = 1 - u;
    return 6 * u * v * (end - begin) + v * (1 - 3 * u) * tangent - u * (2 - 3 * u) * end_tangent;
  };
  const double dx = gap * std::cos(one.yaw);
  const double dy = gap * std::sin(one.yaw);
  const double next_dx = gap * std::cos(next.yaw);
  const double next_dy = gap * std::sin(next.yaw);
  return {.x = blend(one.x, next.x, dx, next_dx),
          .y = blend(one.y, next.y, dy, next_dy),
          .yaw = gap > 0 ? std::atan2(slope(one.y, next.y, dy, next_dy),
                                      slope(one.x, next.x, dx, next_dx))
                         : one.yaw};
}

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

}  // namespace

double WindingPath::y(double x) const noexcept {
  return slope * x + swing * std::sin(full_turn * x / swing_length);
}

Stop WindingPath::at(double x) const noexcept {
  const double wave = full_turn / swing_length;
  return {.x = x, .y = y(x), .yaw = std::atan(slope + swing * wave * std::cos(wave * x))};
}

RoadCurve::RoadCurve(double half_length, double curvature, double begin, double ramp)
    : half_length_(half_length), begin_(begin), ramp_(ramp) {
  Stop stop{.x = -half_length, .y = 0, .yaw = 0};
  for (; stop.x <= half_length + 0.5; stop.x += 1) {
    line_.push_back(stop);
    stop.y += std::tan(stop.yaw);
    stop.yaw += curvature * share(stop.x + 0.5) / std::cos(stop.yaw);
  }
  // Rotates the line so that it is straight along x at x = 0.
  const Stop middle = at(0);
  for (Stop& each : line_) each.y -= middle.y + (each.x - middle.x) * std::tan(middle.yaw);
  for (Stop& each : line_) each.yaw = std::atan(std::tan(each.yaw) - std::tan(middle.yaw));
}

Stop RoadCurve::at(double x) const noexcept {
  const double from_begin =
      std::clamp(x + half_length_, 0.0, static_cast<double>(line_.size() - 1));
  const auto before = std::min(static_cast<std::size_t>(from_begin), line_.size() - 2);
  const double share = x + half_length_ - static_cast<double>(before);
  const Stop& one = line_[before];
  const Stop& next = line_[before + 1];
  return {.x = x,
          .y = one.y + share * (next.y - one.y),
          .yaw = one.yaw + std::clamp(share, 0.0, 1.0) * (next.yaw - one.yaw)};
}

double RoadCurve::share(double x) const noexcept {
  return std::clamp((x - begin_) / ramp_, 0.0, 1.0);
}

}  // namespace flagstone::sim
