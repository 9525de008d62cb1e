// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "lab/sim/route.hpp"
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

/// A round rise of the land, or a dip if its height is below 0, of limited reach. It is nowhere
/// steeper than 1.54 times height / radius.
struct Mound {
  double x, t;            ///< middle, metres; t is y or the distance from a path
  double radius, height;  ///< metres

  [[nodiscard]] double at(double px, double pt) const noexcept {
    const double dx = (px - x) / radius;
    const double dt = (pt - t) / radius;
    const double inside = 1 - dx * dx - dt * dt;
    return inside > 0 ? height * inside * inside : 0;
  }
};

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

/// From 0 to 1 between two values, level at both ends; 0 below `begin`, 1 above `end`.
double smooth_step(double begin, double end, double value) noexcept;

/// Part of a row of grid lines.
struct LineBand {
  double end;   ///< from where the band before it ends, or the row begins, to here
  double step;  ///< between lines, metres
};

/// Lines from `begin` on, band after band; the end of every band is one of them.
std::vector<double> lines_in_bands(double begin, std::span<const LineBand> bands);

/// The same lines and their mirror images: bands from 0 outward, to either side.
std::vector<double> mirrored_lines(std::span<const LineBand> bands);

/// Where something may stand: x, and the distance from a path on either side of it, metres.
struct Strip {
  Interval x{-90, 90};
  Interval from_path;
};

/// Calls `put(x, y)` at random places of a strip on either side of a path, so many a square metre.
void scatter(const WindingPath& path, const Strip& strip, double per_square_metre, Random& random,
             const std::function<void(double x, double y)>& put);

}  // namespace flagstone::sim
