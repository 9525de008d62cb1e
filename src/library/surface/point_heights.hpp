// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "flagstone/label.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/buffer.hpp"
#include "library/core/segment_scan.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// Index of a height and of its grid in one integer: index | grid << grid_shift.
inline constexpr int grid_shift = 28;

/// A point whose label depends on the obstacles in its square.
struct UndecidedPoint {
  std::uint32_t point;  ///< index in its chunk
  std::uint32_t square;
};

/// The grids of a surface as tables with one entry per grid. A position belongs to the last grid
/// that covers it.
struct GridTables {
  std::array<float, 8> extents;         ///< of the outermost centres, or of the edge, metres
  std::array<float, 8> per_cell;        ///< 1 / cell, 1/metre
  std::array<float, 8> middles;         ///< index of the sensor position, between two cells
  std::array<float, 8> last;            ///< index of the last cell of a row
  std::array<std::int32_t, 8> widths;   ///< cells of a row
  std::array<std::int32_t, 8> strides;  ///< 1 | cells of a row << 16
  std::array<std::int32_t, 8> firsts;   ///< index of the first height | grid << grid_shift
  std::size_t count;
  const float* heights;  ///< one row and two more must be readable
  bool reaches_edge;     ///< whether points can lie beyond the outermost centres
};

/// Computes the heights of points above the surface, and their labels.
class PointHeights {
 public:
  /// `grids`: the grids that set_surface() will get. May throw std::bad_alloc.
  PointHeights(const SurfaceConfig& config, const SquareCells& cells, std::span<const Grid> grids);

  /// Reserves memory for scans of up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Sets the surface. The heights of `grids` must be contiguous in memory.
  void set_surface(std::span<const Grid> grids) noexcept;

  /// The results of a chunk, for all points of the cloud.
  struct Results {
    std::span<float> heights;
    std::span<Label> labels;
  };

  /// Computes the heights of the points of a chunk, metres, and marks the squares of the surface
  /// that contain obstacles. Labels all points whose label does not depend on these marks. A height
  /// is NaN if the point is invalid or out of range, or if the surface is unknown there. Several
  /// threads may process different chunks at the same time.
  ///
  /// `unusual` shows which points have no cell; see PackedPoints::unusual.
  void measure(CloudView cloud, const std::uint8_t* unusual, std::size_t chunk,
               const Results& results, LabelTotals& totals) noexcept;

  /// Labels the other points of a chunk. measure() must have finished for all chunks. Several
  /// threads may process different chunks at the same time.
  void label(std::size_t chunk, const Results& results, LabelTotals& totals) noexcept;

 private:
  const SquareCells* cells_;
  PointRule rule_;
  GridTables tables_{};
  Buffer<std::uint8_t> marks_;  ///< two per square of the surface; see ObstacleMarks
  std::size_t mark_count_ = 0;
  std::uint8_t mark_ = 0;                   ///< of the current scan
  Buffer<UndecidedPoint> undecided_;        ///< per chunk, from its first point on
  Buffer<std::uint32_t> undecided_counts_;  ///< per chunk
};

}  // namespace flagstone::surface
