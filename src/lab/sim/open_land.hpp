// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/route.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A plane wave of the land: a sine of x and t, where t is y or the distance from a path.
struct Wave {
  double amplitude = 0;          ///< metres
  double along = 0, across = 0;  ///< along x and t, rad/m
  double phase = 0;              ///< radians

  [[nodiscard]] double at(double x, double t) const noexcept;
};

/// Sum of some waves at (x, t), metres.
double sum_at(std::span<const Wave> waves, double x, double t) noexcept;

/// Adds waves in random directions; amplitude and wavelength in metres.
void draw_waves(std::vector<Wave>& waves, int count, Interval amplitude, Interval length,
                Random& random);

/// Adapts waves to an environment: they close on a circuit.
void close_waves(std::vector<Wave>& waves, const Extent& extent);

/// A round rise of the land, or a dip if its height is negative. Its maximum slope is 1.54 times
/// height / radius.
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

/// A pit with sloping sides on one side of a path. A ramp leads down at its x_begin end.
struct Pit {
  double x_begin = 0, x_end = 0;  ///< metres
  double t_near = 0, t_far = 0;   ///< distances from the path, on one side of it
  double depth = 2;               ///< metres
  double run = 0.6;               ///< of its sides, horizontal distance per metre of depth, m/m
  double ramp = 6;                ///< of the ramp, horizontal distance per metre of depth, m/m

  /// Change of height at x, `out` metres from the path, at most 0, metres.
  [[nodiscard]] double at(double x, double out) const noexcept {
    const double side = std::min({x_end - x, out - t_near, t_far - out}) / run;
    return -std::clamp(std::min(side, (x - x_begin) / ramp), 0.0, depth);
  }
};

/// A narrow trench along a path with upright sides.
struct Trench {
  double x_begin = 0, x_end = 0, t_near = 0, width = 1, depth = 1.2;  ///< metres
  static constexpr double face = 0.08;  ///< width of a side: the ground is a function of x and y

  /// Change of height at x, `out` metres from the path, at most 0, metres.
  [[nodiscard]] double at(double x, double out) const noexcept {
    const double inside =
        std::min({x - x_begin, x_end - x, out - t_near, t_near + width - out}) / face;
    return -depth * std::clamp(inside, 0.0, 1.0);
  }
};

/// A smooth step from 0 to 1 between two values; 0 below `begin`, 1 above `end`.
double smooth_step(double begin, double end, double value) noexcept;

/// A band of evenly spaced grid lines.
struct LineBand {
  double end;   ///< end of the band, which starts at the end of the previous band, metres
  double step;  ///< between lines, metres
};

/// Lines from `begin`, band after band. The end of every band is a line.
std::vector<double> lines_in_bands(double begin, std::span<const LineBand> bands);

/// Lines in bands from 0 outward, and their mirror images.
std::vector<double> mirrored_lines(std::span<const LineBand> bands);

/// An area for objects: x, and the distance from a path on both sides of it, metres.
struct Strip {
  Interval x{-90, 90};
  Interval from_path;
};

/// Calls `put(x, y)` at random positions of a strip on both sides of a path, `per_square_metre`
/// times per square metre.
void scatter(const WindingPath& path, const Strip& strip, double per_square_metre, Random& random,
             const std::function<void(double x, double y)>& put);

}  // namespace flagstone::sim
