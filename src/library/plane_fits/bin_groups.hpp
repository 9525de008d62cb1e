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

/// A point that was moved to its bin.
struct MovedPoint {
  float x, y, z;
  std::uint32_t index;  ///< in the cloud
};

/// What groups are to list.
enum class Listing : std::uint8_t {
  runs,    ///< the runs of each bin; its points, moved together, where runs are short
  points,  ///< the points of each bin, moved together
};

/// The points of a scan grouped by bin: a counting sort of their runs.
///
/// Sorting runs is a tenth of the work of sorting points. Points that are to lie together are then
/// moved in the order of their bins. Where a cloud comes in no order, runs are hardly longer than a
/// point and not worth sorting: the points are, at once.
///
/// Most bins may be empty: they cost next to nothing where sixteen neighbours are.
class BinGroups {
 public:
  explicit BinGroups(Listing listing = Listing::runs) noexcept : listing_(listing) {}

  /// Makes room for scans of `points` points over `bins` bins; may throw std::bad_alloc.
  void reserve(std::size_t points, std::size_t bins);

  /// Groups the runs of a scan of `point_count` points over `groups` bins, the last of which may
  /// stand for points without one. No more than was reserved for.
  void group(const ScanPoints& scan, std::size_t point_count, std::uint32_t groups) noexcept;

  /// Points in a bin.
  [[nodiscard]] std::uint32_t size(std::uint32_t bin) const noexcept {
    return end(bin).points() - first(bin).points();
  }

  /// Whether points() lists the points that were moved; otherwise runs() lists where they are.
  [[nodiscard]] bool moved() const noexcept { return moved_; }

  /// The runs of a bin in input order; unless moved.
  [[nodiscard]] std::span<const Run> runs(std::uint32_t bin) const noexcept {
    return {runs_.data() + first(bin).runs(), runs_.data() + end(bin).runs()};
  }

  /// The points of a bin in input order; if moved. 16 more may be read and are meaningless.
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t bin) const noexcept {
    return points(bin, bin + 1);
  }
  /// The same of the bins from `begin` on, less than `end`, one bin after another.
  [[nodiscard]] std::span<const MovedPoint> points(std::uint32_t begin,
                                                   std::uint32_t end) const noexcept {
    return {points_.data() + first(begin).points(), points_.data() + first(end).points()};
  }

  /// Where the points of the bins from `begin` to `end` begin in points(0, ...): as many numbers as
  /// bins, and where those of the last one end.
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

  /// Bins come in blocks of so many.
  static constexpr std::uint32_t block_size = 16;

  /// What precedes a bin. `bin` may be the number of groups.
  [[nodiscard]] Tally first(std::uint32_t bin) const noexcept {
    return bin % block_size == 0 ? block_firsts_.data()[bin / block_size] : end(bin - 1);
  }
  /// What precedes the bin after it.
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
  std::size_t blocks_ = 0;       ///< there is room for
  std::size_t used_blocks_ = 0;  ///< by the scan before
  /// By bin: what it holds; then what precedes its next run; in the end what precedes the bin after
  /// it. In blocks without points 0 throughout.
  Buffer<Tally> tallies_;
  Buffer<Tally> block_firsts_;        ///< by block: what precedes it
  Buffer<std::uint8_t> block_marks_;  ///< by block: does it hold points? 0 between scans
  Buffer<Run> runs_;
  Buffer<MovedPoint> points_;
};

}  // namespace flagstone::plane_fits
