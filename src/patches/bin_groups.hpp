// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/buffer.hpp"
#include "patches/scan_points.hpp"

namespace flagstone::patches {

/// Consecutive input points that share a bin.
struct Run {
  std::uint32_t begin;   ///< index of the first point
  std::uint32_t length;  ///< number of points, at least 1
};

/// A point that was moved to its bin.
struct MovedPoint {
  float x, y, z;
  std::uint32_t index;  ///< in the cloud
};

/// The points of a scan grouped by bin: a counting sort of their runs, without moving a point.
///
/// Sorting runs is a tenth of the work of sorting points. Where a cloud comes in no order, runs are
/// hardly longer than a point; then the points themselves are sorted, and moved.
class BinGroups {
 public:
  /// Makes room for scans of `points` points over `bins` bins; may throw std::bad_alloc.
  void reserve(std::size_t points, std::size_t bins);

  /// Groups the runs of a scan of `point_count` points over `groups` bins, the last of which may
  /// stand for points without one. No more than was reserved for.
  void group(const ScanPoints& scan, std::size_t point_count, std::uint32_t groups) noexcept;

  /// Points in a bin.
  [[nodiscard]] std::uint32_t size(std::uint32_t bin) const noexcept {
    return static_cast<std::uint32_t>(tallies_.data()[bin] >> 32U);
  }

  /// Whether runs are so short that the points were moved one by one.
  [[nodiscard]] bool scattered() const noexcept { return scattered_; }

  /// The runs of a bin in input order; unless scattered.
  [[nodiscard]] std::span<const Run> runs(std::uint32_t bin) const noexcept {
    return {runs_.data() + first(bin), runs_.data() + first(bin + 1)};
  }

  /// The points of a bin in input order; if scattered. 16 more may be read and are meaningless.
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t bin) const noexcept {
    return {points_.data() + first(bin), points_.data() + first(bin + 1)};
  }

 private:
  [[nodiscard]] std::uint32_t first(std::uint32_t bin) const noexcept {
    return firsts_.data()[bin];
  }
  void tally(const ScanPoints& scan, std::size_t chunks, std::uint32_t groups) noexcept;
  template <class Place>
  void sort(const ScanPoints& scan, std::size_t chunks, const Place& place) noexcept;

  Buffer<std::uint64_t> tallies_;  ///< by bin: points << 32 | runs
  Buffer<std::uint32_t> firsts_;   ///< where a bin begins in the sorted list
  Buffer<std::uint32_t> next_;     ///< where its next entry goes
  Buffer<Run> runs_;
  Buffer<MovedPoint> points_;
  bool scattered_ = false;
};

}  // namespace flagstone::patches
