// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "library/core/buffer.hpp"
#include "library/plane_fits/run_tallies.hpp"
#include "library/plane_fits/scan_points.hpp"

namespace flagstone::plane_fits {

/// Consecutive input points that share a bin.
struct Run {
  std::uint32_t begin;   ///< index of the first point
  std::uint32_t length;  ///< number of points, at least 1
};

/// A point that was copied to its bin.
struct MovedPoint {
  float x, y, z;
  std::uint32_t index;  ///< index in the cloud
};

/// The points of a scan grouped by bin: the runs of each bin, or its points if runs are short.
///
/// Sorting runs is a tenth of the work of sorting points. In an unordered cloud, runs are hardly
/// longer than one point; the points are then copied to their bins.
class BinGroups {
 public:
  /// Reserves memory for scans with up to `points` points in `bins` bins. May throw std::bad_alloc.
  void reserve(std::size_t points, std::size_t bins);

  /// Groups the runs of a scan of `point_count` points into `groups` bins, the last of which can be
  /// for points without a bin. Enough memory must be reserved.
  void group(const ScanPoints& scan, std::size_t point_count, std::uint32_t groups) noexcept;

  /// Number of points in a bin.
  [[nodiscard]] std::uint32_t size(std::uint32_t bin) const noexcept {
    return tallies_.end(bin).points() - tallies_.first(bin).points();
  }

  /// True if points() lists the copied points; otherwise runs() lists their runs.
  [[nodiscard]] bool moved() const noexcept { return moved_; }

  /// The runs of a bin in input order. Only if not moved().
  [[nodiscard]] std::span<const Run> runs(std::uint32_t bin) const noexcept {
    return {runs_.data() + tallies_.first(bin).runs(), runs_.data() + tallies_.end(bin).runs()};
  }

  /// The points of a bin in input order. Only if moved(). 16 more elements can be read; their
  /// values are unspecified.
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t bin) const noexcept {
    return {points_.data() + tallies_.first(bin).points(),
            points_.data() + tallies_.end(bin).points()};
  }

 private:
  bool moved_ = false;
  RunTallies tallies_;
  Buffer<Run> runs_;
  Buffer<MovedPoint> points_;
};

}  // namespace flagstone::plane_fits
