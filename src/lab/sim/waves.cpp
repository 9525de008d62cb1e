// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/waves.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace flagstone::sim
