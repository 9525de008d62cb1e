// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"

namespace flagstone {

/// A scan with the labels and heights of its points.
struct LabelledScan {
  CloudView cloud;
  std::span<const Label> labels;
  std::span<const float> heights;  ///< above the ground, metres
};

/// Which points of a scan to use: those labelled `ground`, and those labelled `nonground` if
/// wanted, between two heights above the ground and nearer than `reach`.
struct PointFilter {
  bool nonground = false;
  float min_height = 0, max_height = 0;  ///< exclusive, metres
  float reach = 0;                       ///< horizontal, in the frame of the sensor, metres
};

/// A grid of columns, rows and levels in the world frame, around a sensor. Points are rounded to
/// float, relative to the sensor.
struct WorldGrid {
  std::array<double, 9> rotation{};   ///< from the sensor frame to the world frame, row by row
  std::array<double, 3> to_sensor{};  ///< from the corner of the grid to the sensor, metres
  double slope_x = 0, slope_y = 0;    ///< subtracted from heights, m/m from the sensor
  double per_metre = 0;               ///< columns and rows per metre
  double per_metre_up = 0;            ///< levels per metre
  std::uint32_t width = 0;            ///< number of columns, and number of rows
  bool on_ground = false;             ///< points are moved down to the ground below them
};

/// The points that pass a filter and are in a grid, out of a few consecutive points.
struct GridPoints {
  static constexpr std::size_t capacity = 512;

  std::size_t count = 0;
  /// Vectors are stored as a whole.
  using Numbers = std::array<std::int32_t, capacity + 16>;
  Numbers point;   ///< index in the scan, ascending
  Numbers column;  ///< of x, rounded down
  Numbers row;     ///< of y, rounded down
  Numbers level;   ///< of z, rounded down; can be negative
};

/// Finds the positions of the points from `begin` on, at most GridPoints::capacity. The same on
/// every instruction set.
void find_in_grid(const LabelledScan& scan, const PointFilter& filter, const WorldGrid& grid,
                  std::size_t begin, GridPoints& points) noexcept;

}  // namespace flagstone
