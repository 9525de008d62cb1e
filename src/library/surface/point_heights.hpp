// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/label.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/buffer.hpp"
#include "library/core/segment_scan.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// The grids of a surface as tables with one entry per grid. A position belongs to the last grid
/// that covers it.
struct GridTables {
  std::array<float, 8> extents;   ///< of the outermost centres, or of the edge, metres
  std::array<float, 8> per_cell;  ///< 1 / cell, 1/metre
  std::array<float, 8> middles;   ///< index of the sensor position, between two cells
  std::array<float, 8> widths;    ///< cells
  std::array<float, 8> firsts;    ///< index of the first height
  std::size_t count;
  const float* heights;
};

/// Computes the heights of points above the surface, and their labels.
class PointHeights {
 public:
  /// May throw std::bad_alloc.
  PointHeights(const SurfaceConfig& config, const SquareCells& cells);

  /// Sets the surface. The heights of `grids` must be contiguous in memory.
  void set_surface(std::span<const Grid> grids) noexcept;

  /// Computes the heights of the points of a chunk, metres, and marks the cells that contain
  /// obstacles. A height is NaN if the point is invalid or out of range, or if the surface is
  /// unknown there. Several threads may process different chunks at the same time.
  void measure(const plane_fits::ScanPoints& scan, std::size_t chunk,
               std::span<float> heights) noexcept;

  /// Labels the points of a chunk. measure() must have finished for all chunks. Several threads may
  /// process different chunks at the same time.
  void label(const plane_fits::ScanPoints& scan, std::size_t chunk, std::span<float> heights,
             std::span<Label> labels, LabelTotals& totals) noexcept;

 private:
  const SquareCells* cells_;
  PointRule rule_;
  GridTables tables_{};
  Buffer<std::uint32_t>
      obstacles_;  ///< obstacle marks, two bytes per 0.5 m cell; see ObstacleCells
  std::size_t obstacle_words_ = 0;
};

}  // namespace flagstone::surface
