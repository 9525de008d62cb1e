// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::tests {

/// Square cells around the sensor, row by row: bins that differ from those of Patchwork.
struct SquareCells {
  float cell;           ///< cell size, metres
  std::uint32_t width;  ///< number of cells along a side

  /// Value for points outside the square and points with non-finite coordinates.
  [[nodiscard]] std::uint32_t outside() const { return width * width; }
  /// Number of cells plus the value for points without a cell.
  [[nodiscard]] std::uint32_t group_count() const { return outside() + 1; }

  /// The cell of a point, or outside().
  [[nodiscard]] std::uint32_t cell_of(const Point& point) const;
};

/// Reads a chunk of the cloud into `scan`, with the cell of each point or outside().
void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan);

}  // namespace flagstone::tests
