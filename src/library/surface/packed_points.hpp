// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/cloud_view.hpp"
#include "library/core/buffer.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// A point in four bytes. Bits 0 to 7 and 8 to 15: x and y within the enclosing cell of 2 m,
/// rounded down to 1/128 m. Bits 16 to 31: height above SquareCells::packed_zero(), rounded to
/// 1/512 m and limited to 64 m above or below it, as a signed integer.
///
/// All steps that estimate the surface use this form. Sums over such integers are exact, so the
/// surface does not depend on the order of the points.
using PackedPoint = std::uint32_t;

/// Units of a packed point per metre.
inline constexpr int xy_per_metre = 128;
inline constexpr int z_per_metre = 512;

/// Side of the cell that x and y of a packed point refer to, metres.
inline constexpr int packed_cell = 2;

/// The points of a scan, packed and sorted by cell. Within a cell they have no particular order.
///
/// If more than a third of the points repeat others, as with some sensors in dual-return mode,
/// equal points of a cell become one. Repeated points then have no influence on the surface.
class PackedPoints {
 public:
  /// Reserves memory for scans of up to `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points, const SquareCells& cells);

  /// Packs the points of a chunk and finds their cells. Several threads can read different chunks
  /// at once.
  void read(CloudView cloud, std::size_t chunk, const SquareCells& cells) noexcept;

  /// Sorts the points of all chunks.
  void sort(std::size_t point_count, const SquareCells& cells) noexcept;

  /// Index of the first point of each cell, and of none() at last. After sort().
  [[nodiscard]] const std::uint32_t* begins() const noexcept { return begins_.data(); }

  /// The points of the cells `first` to `last` - 1, one cell after another. 16 more elements can be
  /// read; their values are unspecified. After sort().
  [[nodiscard]] std::span<const PackedPoint> points(std::uint32_t first,
                                                    std::uint32_t last) const noexcept {
    return {sorted_.data() + begins()[first], sorted_.data() + begins()[last]};
  }

  /// The first of all sorted points.
  [[nodiscard]] const PackedPoint* data() const noexcept { return sorted_.data(); }

  /// For each vector of points that was read at once, at the index of its first point divided by 4:
  /// 0 if all its points have a cell. After read().
  [[nodiscard]] const std::uint8_t* unusual() const noexcept { return unusual_.data(); }

 private:
  [[nodiscard]] bool repeat(std::size_t point_count) noexcept;
  void remove_repeated() noexcept;
  [[nodiscard]] std::span<PackedPoint> mutable_points(std::uint32_t cell) noexcept;

  std::uint32_t cell_count_ = 0;
  Buffer<PackedPoint> packed_;  ///< in input order; after sort() free for other uses
  Buffer<PackedPoint> sorted_;
  Buffer<std::uint8_t> unusual_;
  plane_fits::ScanRuns runs_;
  Buffer<std::uint32_t> begins_;
};

}  // namespace flagstone::surface
