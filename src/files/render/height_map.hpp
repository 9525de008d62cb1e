// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/ground_surface.hpp"

namespace flagstone::render {

/// A range of heights, metres.
struct HeightRange {
  double lowest = 0;
  double highest = 1;
  [[nodiscard]] double span() const noexcept { return highest - lowest; }
};

/// Heights at the centres of equal square cells, in map order: rows from the largest y to the
/// smallest, x ascending within a row. The sensor is in the middle, at the corner of four cells.
struct HeightMap {
  double cell = 1;             ///< side of a cell, metres
  std::size_t width = 0;       ///< cells along a side, even
  std::vector<float> heights;  ///< metres; NaN if unknown

  /// The map covers |x| <= extent and |y| <= extent, metres.
  [[nodiscard]] double extent() const noexcept { return static_cast<double>(width) * cell / 2; }

  /// Metres in the sensor frame at a column and a row; integers are centres of cells.
  [[nodiscard]] double x(double column) const noexcept { return (column + 0.5) * cell - extent(); }
  [[nodiscard]] double y(double row) const noexcept { return extent() - (row + 0.5) * cell; }
};

/// The heights of `surface` in cells of `cell` metres that cover |x|, |y| <= `extent` metres.
HeightMap map_of(const GroundSurface& surface, double extent, double cell);

/// As map_of(), but smoothed for contour lines, which otherwise bend at the cells of the surface:
/// each height is the mean of four heights, half a cell of the surface away along x and y.
HeightMap smoothed_map_of(const GroundSurface& surface, double extent, double cell);

}  // namespace flagstone::render
