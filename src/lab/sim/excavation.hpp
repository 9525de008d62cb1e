// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace flagstone::sim {

/// A pit with sloping sides on one side of a path; at its end of low x a ramp leads down.
struct Pit {
  double x_begin = 0, x_end = 0;  ///< metres
  double t_near = 0, t_far = 0;   ///< distances from the path, on one side of it
  double depth = 2;               ///< metres
  double run = 0.6;               ///< of its sides, metres out for a metre down
  double ramp = 6;                ///< the same of the ramp

  /// How deep the ground is dug at x, `out` metres from the path, below 0.
  [[nodiscard]] double at(double x, double out) const noexcept {
    const double side = std::min({x_end - x, out - t_near, t_far - out}) / run;
    return -std::clamp(std::min(side, (x - x_begin) / ramp), 0.0, depth);
  }
};

/// A narrow trench along a path with upright sides.
struct Trench {
  double x_begin = 0, x_end = 0, t_near = 0, width = 1, depth = 1.2;  ///< metres
  static constexpr double face = 0.08;  ///< sides lean, so that the ground stays a function

  /// How deep the ground is dug at x, `out` metres from the path, below 0.
  [[nodiscard]] double at(double x, double out) const noexcept {
    const double inside =
        std::min({x - x_begin, x_end - x, out - t_near, t_near + width - out}) / face;
    return -depth * std::clamp(inside, 0.0, 1.0);
  }
};

}  // namespace flagstone::sim
