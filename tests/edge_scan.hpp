// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"

namespace flagstone::tests {

/// z of some ground at x, y, metres, sensor frame.
using GroundHeight = std::function<float(float x, float y)>;

/// What a spinning sensor 1.73 m above the ground sees of it to the left, up to 25 m away: beams
/// half a degree apart, each point where its beam first meets the ground, so that edges hide what
/// lies behind them.
std::vector<Point> edge_scan(const GroundHeight& ground);

/// Level ground at -1.73 m that changes by `rise` along y = 5 m, over 5 cm.
GroundHeight step_of(float rise);

/// The same with a ditch along y = 5 m: `depth` deep, its bottom 2 m wide, its sides 1 m.
GroundHeight ditch_of(float depth);

/// Adds `count` lone ghosts, each 0.4 to 2.4 m below a point of the scan that is less than 15 m
/// away. They are the last points.
void add_ghosts(std::vector<Point>& scan, std::size_t count);

/// Share of the points chosen by `belongs` that have this label. Fails if it chooses few.
double share_of(Label label, const std::vector<Point>& cloud, const std::vector<Label>& labels,
                const std::function<bool(const Point&)>& belongs);

}  // namespace flagstone::tests
