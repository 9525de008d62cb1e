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

/// The grids of a surface as tables, an entry for each; a place belongs to the last one that
/// reaches it.
struct GridTables {
  std::array<float, 8> extents;   ///< to the last centres, or to the edge, metres
  std::array<float, 8> per_cell;  ///< 1 / cell, 1/metre
  std::array<float, 8> middles;   ///< index of the sensor's place: between two cells
  std::array<float, 8> widths;    ///< cells
  std::array<float, 8> firsts;    ///< index of the first height
  std::size_t count;
  const float* heights;
};

/// Heights of points above the surface, and the labels that follow from them.
class PointHeights {
 public:
  /// May throw std::bad_alloc.
  PointHeights(const SurfaceConfig& config, const SquareCells& cells);

  /// The surface to measure from: grids that lie one after another in memory.
  void set_surface(std::span<const Grid> grids) noexcept;

  /// Measures the heights of a chunk's points, metres, and notes where something stands. NaN for
  /// points that are invalid or out of range, and where the surface is not known. Chunks may be
  /// measured by several threads at once.
  void measure(const plane_fits::ScanPoints& scan, std::size_t chunk,
               std::span<float> heights) noexcept;

  /// Labels a chunk's points once all chunks are measured. Chunks may be labelled by several
  /// threads at once.
  void label(const plane_fits::ScanPoints& scan, std::size_t chunk, std::span<float> heights,
             std::span<Label> labels, LabelTotals& totals) noexcept;

 private:
  const SquareCells* cells_;
  PointRule rule_;
  GridTables tables_{};
  Buffer<std::uint32_t>
      standing_;  ///< two bytes for each cell of 0.5 m: does something stand there?
  std::size_t standing_words_ = 0;
};

}  // namespace flagstone::surface
