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

/// A simulated scan of a street by an HDL-64E at a height of 1.73 m, without faults.
const std::vector<Point>& street_scan();

/// Ground truth of its points.
const std::vector<Truth>& street_truth();

/// Points as a cloud of x, y and z.
io::Cloud cloud_of(const std::vector<Point>& points);

/// Points as a cloud of x, y and z with a field `ring`.
io::Cloud cloud_of(const std::vector<Point>& points, const std::vector<float>& rings);

/// Applies `change` to every point.
std::vector<Point> changed(std::vector<Point> points, const std::function<Point(Point)>& change);

/// The points in a random order, always the same one.
std::vector<Point> shuffled(std::vector<Point> points);

/// The mean of the points in each voxel of `side` metres.
std::vector<Point> voxel_means(const std::vector<Point>& points, float side);

}  // namespace flagstone::doctor
