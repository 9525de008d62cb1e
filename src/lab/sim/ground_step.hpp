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

/// A straight, sharp change of the height of the ground along the x axis of the world frame, with
/// the same shape along its length. Metres.
struct GroundStep {
  std::string_view kind;          ///< name in tables
  double x_begin = 0, x_end = 0;  ///< along the step
  double y_begin = 0, y_end = 0;  ///< across the step, from the edge closer to the path
  double rise = 0;                ///< from y_begin to y_end; negative for a drop
};

/// Heights of a ground: z at (x, y), metres, sensor frame; NaN if unknown.
using HeightAt = std::function<double(double x, double y)>;

/// A position on a step, in the sensor frame.
struct StepPlace {
  double x = 0, y = 0;                ///< start of the step, metres
  double across_x = 0, across_y = 0;  ///< direction across the step, length 1
  double width = 0;                   ///< from the start to the end of the step, metres
};

/// Distance before and behind a step at which heights are evaluated, metres.
inline constexpr double beside_step = 0.5;

/// A step as represented in some heights, at one position.
struct StepView {
  /// Height behind the step minus height before it, each at a distance of beside_step, metres; NaN
  /// if either is unknown.
  double rise = 0;
  /// Horizontal distance between 10 % and 90 % of that rise, metres. Nothing if there is no rise or
  /// if a height in between is unknown.
  std::optional<double> width;
};

/// Positions on a step, 1 m apart.
std::vector<StepPlace> places_on(const GroundStep& step, const Ground& ground, const Frame& pose);

/// Measures a step in some heights.
StepView view_step(const StepPlace& place, const HeightAt& height);

/// The heights of a ground in the frame of a sensor at `pose`: the first ground downwards along its
/// z axis. Both arguments must outlive the function.
HeightAt true_heights(const Ground& ground, const Frame& pose);

/// The sides of a step on which the sensor has seen the ground.
struct SeenSides {
  bool before = false, behind = false;
};

/// The sides that have a ground point within beside_step of the step, and within beside_step along
/// it. `ground_points` contains x and y of the ground points of the scan.
SeenSides seen_sides(const StepPlace& place, std::span<const float> ground_points);

}  // namespace flagstone::sim
