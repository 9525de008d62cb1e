// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lab/sim/interval.hpp"
#include "lab/sim/route.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// The line that a vehicle follows over open land: along x, swinging to either side.
struct WindingPath {
  double swing = 0;           ///< to either side, metres
  double swing_length = 100;  ///< from one swing to the next of the same side, metres
  double slope = 0;           ///< of the line it swings about, metres to the left a metre

  [[nodiscard]] double y(double x) const noexcept;

  /// The place and direction at x, for wander_along().
  [[nodiscard]] Stop at(double x) const noexcept;
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
