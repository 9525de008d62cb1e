// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::tests {

/// Square cells around the sensor, row by row: another way to find the bin of a point than
/// Patchwork's.
struct SquareCells {
  float cell;           ///< side, metres
  std::uint32_t width;  ///< cells along a side

  /// What points have instead of a cell that lie outside of the square or nowhere.
  [[nodiscard]] std::uint32_t outside() const { return width * width; }
  /// Cells and that.
  [[nodiscard]] std::uint32_t group_count() const { return outside() + 1; }

  /// The cell of a point, or outside().
  [[nodiscard]] std::uint32_t cell_of(const Point& point) const;
};

/// Reads a chunk of the cloud into `scan`, each point in its cell or outside().
void read_chunk(CloudView cloud, std::size_t chunk, const SquareCells& cells,
                plane_fits::ScanPoints& scan);

}  // namespace flagstone::tests
