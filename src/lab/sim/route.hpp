// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lab/sim/extent.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Position and heading of a vehicle: metres, and radians counter-clockwise from the x axis.
struct Stop {
  double x = 0, y = 0, yaw = 0;
};

/// The stops of a run along a path, given by its position and direction at x. As in real driving,
/// every stop deviates from the path by up to 0.5 m along, 0.25 m across and 2 degrees.
std::vector<Stop> wander_along(const std::function<Stop(double x)>& path, Random& random,
                               const Extent& extent = {});

/// The pose on the way through `stops`, a curve that passes each stop in its direction. `at` counts
/// stops: 0 is the first one, 0.5 halfway to the next. Beyond the last stop it is the last one.
Stop between_stops(std::span<const Stop> stops, double at) noexcept;

/// The path of a vehicle over open land: along x, swinging to both sides.
struct WindingPath {
  double swing = 0;           ///< amplitude to each side, metres
  double swing_length = 100;  ///< wavelength of the swings, metres
  double slope = 0;           ///< of the line that it swings about, to the left, m/m

  [[nodiscard]] double y(double x) const noexcept;

  /// The position and direction at x, for wander_along().
  [[nodiscard]] Stop at(double x) const noexcept;
};

/// The line of a road in plan: straight at x = 0, then a curve. Its curvature increases linearly
/// over `ramp` metres from `begin`, as when a driver turns the wheel.
class RoadCurve {
 public:
  /// `curvature` in rad/m, to the left. The line covers x from -half_length to half_length.
  RoadCurve(double half_length, double curvature, double begin, double ramp);

  /// Position and direction of the line at x.
  [[nodiscard]] Stop at(double x) const noexcept;

  /// Fraction of the full curvature at x, 0..1.
  [[nodiscard]] double share(double x) const noexcept;

 private:
  double half_length_, begin_, ramp_;
  std::vector<Stop> line_;  // 1 m apart
};

}  // namespace flagstone::sim
