// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "library/core/buffer.hpp"
#include "library/plane_fits/bin_batch.hpp"
#include "library/surface/packed_points.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// At most 32 points of each cell of 2 m, selected by their content. Planes are fitted to them, and
/// they refine the coarsest level.
class CoarseSamples {
 public:
  /// Maximum number of points of a cell.
  static constexpr std::size_t most = 32;

  /// `cells` must outlive this object. May throw std::bad_alloc.
  explicit CoarseSamples(const SquareCells& cells);

  /// Reserves memory for scans of up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Selects the points of a scan.
  void take(const PackedPoints& points) noexcept;

  /// The selected points of the coarse cells `first` to `last` - 1; see CoarseCells. 16 more
  /// elements can be read.
  [[nodiscard]] std::span<const PackedPoint> points(std::uint32_t first,
                                                    std::uint32_t last) const noexcept {
    return {samples_.data() + begins_.data()[first], samples_.data() + begins_.data()[last]};
  }

  /// Index of the first selected point of each coarse cell, and the number of all.
  [[nodiscard]] const std::uint32_t* begins() const noexcept { return begins_.data(); }
  [[nodiscard]] const PackedPoint* data() const noexcept { return samples_.data(); }

  /// Adds a patch to the batch, on the grid of plane_fits::ExactGrid, with z relative to the
  /// SquareCells::packed_zero(). Uses at most 128 points.
  void add_patch(const SquarePatch& patch, plane_fits::BinBatch& batch) const noexcept;

 private:
  std::span<const CellRange> blocks_;  ///< of the cells
  float packed_zero_;
  Buffer<PackedPoint> samples_;
  Buffer<std::uint32_t> begins_;
};

}  // namespace flagstone::surface
