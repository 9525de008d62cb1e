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

/// A scan of the ground to the left of a spinning sensor at a height of 1.73 m, up to 25 m away.
/// Beams are half a degree apart. Each point is where its beam first meets the ground, so that
/// edges occlude the ground behind them.
std::vector<Point> edge_scan(const GroundHeight& ground);

/// Level ground at -1.73 m with a step of `rise` along y = 5 m, 5 cm wide.
GroundHeight step_of(float rise);

/// Level ground at -1.73 m with a ditch along y = 5 m: `depth` deep, its bottom 2 m wide, its sides
/// 1 m.
GroundHeight ditch_of(float depth);

/// Appends `count` single ghost points, each 0.4 to 2.4 m below a point of the scan that is less
/// than 15 m away.
void add_ghosts(std::vector<Point>& scan, std::size_t count);

/// Fraction of the points selected by `belongs` that have this label. Fails if it selects only a
/// few.
double share_of(Label label, const std::vector<Point>& cloud, const std::vector<Label>& labels,
                const std::function<bool(const Point&)>& belongs);

}  // namespace flagstone::tests
