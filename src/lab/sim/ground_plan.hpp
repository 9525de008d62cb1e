// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lab/sim/ground.hpp"

namespace flagstone::sim {

/// Adds lines from `begin` to `end` inclusive, evenly spaced, at most `step` apart.
void add_lines(std::vector<double>& lines, double begin, double end, double step);

/// Sorts, and drops lines that are so near to another one that only rounding tells them apart.
void finish_lines(std::vector<double>& lines);

/// A ground as formulas, and the lines at which they are taken. Metres; t is measured to the left
/// of a line that runs along x.
struct GroundPlan {
  std::vector<double> x, t;                            ///< ascending, see finish_lines()
  std::function<double(double x)> offset;              ///< y of t = 0
  std::function<double(double x, double t)> height;    ///< at the crossings of the lines
  std::function<Surface(double x, double t)> surface;  ///< in the middle of every cell
};

/// The plan as triangles.
Ground cut_ground(GroundPlan plan);

}  // namespace flagstone::sim
