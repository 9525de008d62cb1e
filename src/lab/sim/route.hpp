// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "library/core/random.hpp"

namespace flagstone::sim {

/// How many frames are taken of one world.
inline constexpr int frames_per_drive = 10;

/// Way between one frame and the next, metres: so far that scans of a drive differ.
inline constexpr double frame_spacing = 8;

/// Half of the way of a drive, metres: from x = -half_drive to half_drive.
inline constexpr double half_drive = (frames_per_drive - 1) * frame_spacing / 2;

/// Where a vehicle stands: metres, and radians counter-clockwise from the x axis.
struct Stop {
  double x = 0, y = 0, yaw = 0;
};

/// The stops of a drive along a path that is given by its place and direction at x. Nobody drives
/// along a line: every stop is off by up to 0.5 m along, 0.25 m across and 2 degrees.
std::vector<Stop> wander_along(const std::function<Stop(double x)>& path, Random& random);

/// The line that a vehicle follows over open land: along x, swinging to either side.
struct WindingPath {
  double swing = 0;           ///< to either side, metres
  double swing_length = 100;  ///< from one swing to the next of the same side, metres
  double slope = 0;           ///< of the line it swings about, metres to the left a metre

  [[nodiscard]] double y(double x) const noexcept;

  /// The place and direction at x, for wander_along().
  [[nodiscard]] Stop at(double x) const noexcept;
};

/// The line of a road in plan: straight at x = 0, into a curve whose curvature grows evenly, as
/// drivers turn the wheel, from `begin` on over `ramp` metres.
class RoadCurve {
 public:
  /// `curvature` in radians a metre, to the left; covers x from -half_length to half_length.
  RoadCurve(double half_length, double curvature, double begin, double ramp);

  /// Where the line is at x, and its direction.
  [[nodiscard]] Stop at(double x) const noexcept;

  /// How much of the curve's curvature the line has at x, 0..1.
  [[nodiscard]] double share(double x) const noexcept;

 private:
  double half_length_, begin_, ramp_;
  std::vector<Stop> line_;  // a metre apart
};

}  // namespace flagstone::sim
