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

}  // namespace flagstone::sim
