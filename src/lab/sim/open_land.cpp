// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/open_land.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lab/sim/ground_plan.hpp"

namespace flagstone::sim {
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

double smooth_step(double begin, double end, double value) noexcept {
  const double share = std::clamp((value - begin) / (end - begin), 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

std::vector<double> lines_in_bands(double begin, std::span<const LineBand> bands) {
  std::vector<double> lines;
  for (const LineBand& band : bands) {
    add_lines(lines, begin, band.end, band.step);
    begin = band.end;
  }
  finish_lines(lines);
  return lines;
}

std::vector<double> mirrored_lines(std::span<const LineBand> bands) {
  std::vector<double> lines = lines_in_bands(0, bands);
  const std::vector<double> outward = lines;
  for (const double line : outward) lines.push_back(-line);
  finish_lines(lines);
  return lines;
}

void scatter(const WindingPath& path, const Strip& strip, double per_square_metre, Random& random,
             const std::function<void(double x, double y)>& put) {
  const double length = strip.x.high - strip.x.low;
  const double area = 2 * length * (strip.from_path.high - strip.from_path.low);
  const int count = static_cast<int>(per_square_metre * area);
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(strip.x.low, strip.x.high);
    const double t = random.uniform(strip.from_path.low, strip.from_path.high);
    put(x, path.y(x) + (random.chance(0.5) ? t : -t));
  }
}

}  // namespace flagstone::sim
