// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/cloud_view.hpp"

namespace flagstone::tests {

/// A cloud that resembles a scan: tilted, slightly rough ground 1.73 m below the sensor, with walls
/// and boxes, in the order of a spinning sensor. The same seed gives the same points.
std::vector<Point> random_cloud(std::size_t points, std::uint32_t seed);

/// A random cloud in which some points are replaced as by broken sensors and drivers: NaN,
/// infinities, zeros, negative zeros, denormals, huge numbers, duplicate points, points exactly on
/// bin boundaries.
std::vector<Point> corrupted_cloud(std::size_t points, std::uint32_t seed);

inline CloudView view_of(const std::vector<Point>& points) {
  return CloudView(std::span<const Point>(points));
}

}  // namespace flagstone::tests
