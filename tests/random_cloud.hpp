// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone::tests {

/// A cloud for tests that need something like a scan: a tilted, slightly rough ground 1.73 m below
/// the sensor, walls and boxes on it, in the order a spinning sensor would deliver them. The same
/// seed gives the same points.
std::vector<Point> random_cloud(std::size_t points, std::uint32_t seed);

/// The same with a share of its points replaced by what broken sensors and drivers send: NaN,
/// infinities, zeros, negative zeros, denormals, huge numbers, repeated points, exact bin
/// boundaries.
std::vector<Point> corrupted_cloud(std::size_t points, std::uint32_t seed);

inline CloudView view_of(const std::vector<Point>& points) {
  return CloudView(std::span<const Point>(points));
}

}  // namespace flagstone::tests
