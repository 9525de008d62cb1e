// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "library/plane_fits/scan_points.hpp"

namespace flagstone::plane_fits {

/// Consecutive input points that share a bin.
struct Run {
  std::uint32_t begin;   ///< index of the first point
  std::uint32_t length;  ///< number of points, at least 1
};

/// A point that was moved to its bin.
struct MovedPoint {
  float x, y, z;
  std::uint32_t index;  ///< in the cloud
};

/// Writes the points of the runs one after another. There is room for 16 more, which may be
/// overwritten.
void move_points(const ScanPoints& scan, std::span<const Run> runs, MovedPoint* points) noexcept;

}  // namespace flagstone::plane_fits
