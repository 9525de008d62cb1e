// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/open_land.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "lab/sim/ground.hpp"

namespace flagstone::sim {

double Wave::at(double x, double t) const noexcept {
  return amplitude * std::sin(along * x + across * t + phase);
}

double sum_at(std::span<const Wave> waves, double x, double t) noexcept {
  double sum = 0;
  for (const Wave& wave : waves) sum += wave.at(x, t);
  return sum;
}

void draw_waves(std::vector<Wave>& waves, int count, Interval amplitude, Interval length,
                Random& random) {
  constexpr double full_turn = 2 * std::numbers::pi;
  for (int i = 0; i < count; ++i) {
    const double direction = random.uniform(0, full_turn);
    const double wave = full_turn / random.uniform(length.low, length.high);
    waves.push_back({.amplitude = random.uniform(amplitude.low, amplitude.high),
                     .along = wave * std::cos(direction),
                     .across = wave * std::sin(direction),
                     .phase = random.uniform(0, full_turn)});
  }
}

void close_waves(std::vector<Wave>& waves, const Extent& extent) {
  for (Wave& wave : waves) wave.along = extent.fitted(wave.along);
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
