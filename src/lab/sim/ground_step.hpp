// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"

namespace flagstone::sim {

/// A straight, sharp change of the ground's height that runs along the x axis of the world, of the
/// same shape from one end to the other. Metres.
struct GroundStep {
  std::string_view kind;          ///< as tables call it
  double x_begin = 0, x_end = 0;  ///< along the step
  double y_begin = 0, y_end = 0;  ///< across it: from the edge nearer to the path to the other
  double rise = 0;                ///< from y_begin to y_end, below 0 for a drop
};

/// Heights of a ground: z at x, y, metres, sensor frame; NaN where not known.
using HeightAt = std::function<double(double x, double y)>;

/// One place on a step, in the sensor frame.
struct StepPlace {
  double x = 0, y = 0;                ///< where the step begins, metres
  double across_x = 0, across_y = 0;  ///< the direction in which it rises or falls, length 1
  double width = 0;                   ///< from where it begins to where it ends, metres
};

/// How far before and behind a step heights are taken, metres.
inline constexpr double beside_step = 0.5;

/// What some ground makes of a step at one place.
struct StepView {
  /// Height behind it minus height before it, each beside_step away from it, metres; NaN where
  /// either is not known.
  double rise = 0;
  /// Metres across from where the height has done 10 % of that rise to where it has done 90 %;
  /// nothing where it does not rise, or is not known all the way.
  std::optional<double> width;
};

/// Places on a step, a metre from one to the next.
std::vector<StepPlace> places_on(const GroundStep& step, const Ground& ground, const Frame& pose);

/// Looks at a step in some heights.
StepView view_step(const StepPlace& place, const HeightAt& height);

/// The heights of a ground as a sensor at `pose` has them: the first ground met on the way down its
/// z axis. Both must outlive the function.
HeightAt true_heights(const Ground& ground, const Frame& pose);

/// On which sides of a step the sensor has seen the ground.
struct SeenSides {
  bool before = false, behind = false;
};

/// On which sides is there a point of the ground within beside_step of the step, and as far along
/// it to either side? `ground_points` holds x and y of the scan's ground points.
SeenSides seen_sides(const StepPlace& place, std::span<const float> ground_points);

}  // namespace flagstone::sim
