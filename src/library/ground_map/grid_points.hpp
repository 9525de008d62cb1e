// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone {

/// Which points of a scan to use: those labelled `ground`, and those labelled `nonground` if
/// wanted, between two heights above the ground and nearer than `reach`.
struct PointFilter {
  bool nonground = false;
  float min_height = 0, max_height = 0;  ///< exclusive, metres
  float reach = 0;                       ///< horizontal, in the frame of the sensor, metres
};

/// A grid of columns, rows and levels in the world frame, around a sensor.
struct WorldGrid {
  std::array<double, 9> rotation{};   ///< from the sensor frame to the world frame, row by row
  std::array<double, 3> to_sensor{};  ///< from the corner of the grid to the sensor, metres
  double slope_x = 0, slope_y = 0;    ///< subtracted from heights, m/m from the sensor
  double per_metre = 0;               ///< columns and rows per metre
  double per_metre_up = 0;            ///< levels per metre
  std::uint32_t width = 0;            ///< number of columns, and number of rows
  bool on_ground = false;             ///< points are moved down to the ground below them
};

/// The positions of consecutive points in a grid.
struct GridPoints {
  static constexpr std::size_t capacity = 512;

  /// Level of the corner of the grid, so that levels are positive.
  static constexpr std::int32_t base_level = 1 << 30;

  std::size_t count = 0;
  alignas(64) std::array<std::int32_t, capacity> column;  ///< of x, rounded down
  alignas(64) std::array<std::int32_t, capacity> row;     ///< of y, rounded down
  alignas(64) std::array<std::int32_t, capacity> level;   ///< of z, rounded down, plus base_level

  /// False for a point that does not pass the filter or is outside of the grid.
  [[nodiscard]] bool inside(std::size_t i) const noexcept {
    return (column[i] | row[i] | level[i]) >= 0;
  }
};

/// Finds the positions of the points from `begin` on, at most GridPoints::capacity. The result has
/// labels and heights for all points of the cloud.
void find_in_grid(const CloudView& cloud, const Segmentation& result, const PointFilter& filter,
                  const WorldGrid& grid, std::size_t begin, GridPoints& points) noexcept;

}  // namespace flagstone
