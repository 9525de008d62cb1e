// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "library/core/buffer.hpp"
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

/// The form in which groups list points.
enum class Listing : std::uint8_t {
  runs,    ///< the runs of each bin, or its points if runs are short
  points,  ///< the points of each bin, copied next to each other
};

/// The points of a scan grouped by bin: a counting sort of their runs.
///
/// Sorting runs is a tenth of the work of sorting points. If points must be next to each other,
/// they are then copied in the order of their bins. In an unordered cloud, runs are hardly longer
/// than one point; the points are then sorted directly.
///
/// Most bins can be empty: sixteen empty neighbours take almost no time.
class BinGroups {
 public:
  explicit BinGroups(Listing listing = Listing::runs) noexcept : listing_(listing) {}

  /// Reserves memory for scans with up to `points` points in `bins` bins. May throw std::bad_alloc.
  void reserve(std::size_t points, std::size_t bins);

  /// Groups the runs of a scan of `point_count` points into `groups` bins, the last of which can be
  /// for points without a bin. Enough memory must be reserved.
  void group(const ScanPoints& scan, std::size_t point_count, std::uint32_t groups) noexcept;

  /// Number of points in a bin.
  [[nodiscard]] std::uint32_t size(std::uint32_t bin) const noexcept {
    return end(bin).points() - first(bin).points();
  }

  /// True if points() lists the copied points; otherwise runs() lists their runs.
  [[nodiscard]] bool moved() const noexcept { return moved_; }

  /// The runs of a bin in input order. Only if not moved().
  [[nodiscard]] std::span<const Run> runs(std::uint32_t bin) const noexcept {
    return {runs_.data() + first(bin).runs(), runs_.data() + end(bin).runs()};
  }

  /// The points of a bin in input order. Only if moved(). 16 more elements can be read; their
  /// values are unspecified.
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t bin) const noexcept {
    return points(bin, bin + 1);
  }
  /// The points of the bins `begin` to `end` - 1, one bin after another. Only if moved().
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t begin,
                                                   std::uint32_t end) const noexcept {
    return {points_.data() + first(begin).points(), points_.data() + first(end).points()};
  }

  /// Writes the index in points(0, ...) of the first point of each of the bins `begin` to `end` -
  /// 1, and the index after the last point of the last bin.
  void list_begins(std::uint32_t begin, std::uint32_t end, std::uint32_t* begins) const noexcept;

 private:
  /// Numbers of points and runs, counted in one word.
  struct Tally {
    std::uint64_t word = 0;  ///< points << 32 | runs

    void add(Tally other) noexcept { word += other.word; }
    static Tally run_of(std::uint32_t length) noexcept {
      return {std::uint64_t{length} << 32U | 1U};
    }
    [[nodiscard]] std::uint32_t points() const noexcept {
      return static_cast<std::uint32_t>(word >> 32U);
    }
    [[nodiscard]] std::uint32_t runs() const noexcept { return static_cast<std::uint32_t>(word); }
  };

  /// Number of bins per block.
  static constexpr std::uint32_t block_size = 16;

  /// Tally of all bins before `bin`, which can be the number of groups.
  [[nodiscard]] Tally first(std::uint32_t bin) const noexcept {
    return bin % block_size == 0 ? block_firsts_.data()[bin / block_size] : end(bin - 1);
  }
  /// Tally of all bins up to and including `bin`.
  [[nodiscard]] Tally end(std::uint32_t bin) const noexcept {
    const std::uint32_t block = bin / block_size;
    return is_empty(block) ? block_firsts_.data()[block] : tallies_.data()[bin];
  }
  [[nodiscard]] bool is_empty(std::size_t block) const noexcept {
    return block_firsts_.data()[block].word == block_firsts_.data()[block + 1].word;
  }

  void tally(const ScanPoints& scan, std::size_t chunks) noexcept;
  Tally sum_up(std::uint32_t groups) noexcept;
  template <class Place>
  void sort(const ScanPoints& scan, std::size_t chunks, const Place& place) noexcept;

  Listing listing_;
  bool moved_ = false;
  std::size_t blocks_ = 0;       ///< number of blocks with reserved memory
  std::size_t used_blocks_ = 0;  ///< number of blocks that the previous scan used
  /// Per bin: at first the tally of the bin, then the tally before its next run, in the end the
  /// tally up to and including the bin. All 0 in blocks without points.
  Buffer<Tally> tallies_;
  Buffer<Tally> block_firsts_;        ///< per block: tally of all bins before it
  Buffer<std::uint8_t> block_marks_;  ///< per block: 1 if it contains points; 0 between scans
  Buffer<Run> runs_;
  Buffer<MovedPoint> points_;
};

}  // namespace flagstone::plane_fits
