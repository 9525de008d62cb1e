// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace flagstone {

/// A square of vertical columns around a sensor, along the axes of the world frame, row by row.
struct ColumnGrid {
  float offset_x = 0, offset_y = 0;  ///< from the corner of the square to the sensor, metres
  float per_metre = 0;               ///< columns and rows per metre
  std::uint32_t width = 0;           ///< number of columns, and number of rows

  /// The index of positions that are not in the square.
  [[nodiscard]] constexpr std::uint32_t outside() const noexcept { return width * width; }

  /// Index of the column at (dx, dy) metres from the sensor. The outermost columns are outside, so
  /// that every column inside has eight neighbours.
  [[nodiscard]] constexpr std::uint32_t column_at(float dx, float dy) const noexcept {
    const float column = (dx + offset_x) * per_metre;
    const float row = (dy + offset_y) * per_metre;
    const auto is_inside = [last = static_cast<float>(width - 1)](float index) {
      return index >= 1 && index < last;
    };
    if (!is_inside(column) || !is_inside(row)) return outside();
    return static_cast<std::uint32_t>(row) * width + static_cast<std::uint32_t>(column);
  }
};

}  // namespace flagstone
