// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "lab/sim/interval.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A straight wave of the land: a sine of x and of t, which is y or the distance from a path.
struct Wave {
  double amplitude = 0;          ///< metres
  double along = 0, across = 0;  ///< radians a metre of x and of t
  double phase = 0;              ///< radians

  [[nodiscard]] double at(double x, double t) const noexcept;
};

/// Sum of some waves at a place.
double sum_at(std::span<const Wave> waves, double x, double t) noexcept;

/// Adds waves of every direction; amplitude and length in metres.
void draw_waves(std::vector<Wave>& waves, int count, Interval amplitude, Interval length,
                Random& random);

}  // namespace flagstone::sim
