// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "files/io/cloud.hpp"
#include "flagstone/cloud_view.hpp"
#include "library/core/truth.hpp"

namespace flagstone::doctor {

/// A scan of a simulated street by an HDL-64E 1.73 m above it: nothing is wrong with it.
const std::vector<Point>& street_scan();

/// Which of its points are ground.
const std::vector<Truth>& street_truth();

/// Points as a cloud of x, y and z.
io::Cloud cloud_of(const std::vector<Point>& points);

/// The same with a field `ring`.
io::Cloud cloud_of(const std::vector<Point>& points, const std::vector<float>& rings);

/// Every point as `change` makes it.
std::vector<Point> changed(std::vector<Point> points, const std::function<Point(Point)>& change);

/// The points in an order of chance, the same each time.
std::vector<Point> shuffled(std::vector<Point> points);

/// The mean of the points of each voxel, `side` metres wide.
std::vector<Point> voxel_means(const std::vector<Point>& points, float side);

}  // namespace flagstone::doctor
