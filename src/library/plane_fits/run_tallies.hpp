// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "library/core/buffer.hpp"
#include "library/plane_fits/scan_runs.hpp"

namespace flagstone::plane_fits {

/// Numbers of points and runs, counted in one word.
struct Tally {
  std::uint64_t word = 0;  ///< points << 32 | runs

  void add(Tally other) noexcept { word += other.word; }
  static Tally run_of(std::uint32_t length) noexcept { return {std::uint64_t{length} << 32U | 1U}; }
  [[nodiscard]] std::uint32_t points() const noexcept {
    return static_cast<std::uint32_t>(word >> 32U);
  }
  [[nodiscard]] std::uint32_t runs() const noexcept { return static_cast<std::uint32_t>(word); }
};

/// A counting sort of the runs of a scan by bin. Most bins can be empty: sixteen empty neighbours
/// take almost no time.
class RunTallies {
 public:
  /// Reserves memory for `bins` bins. May throw std::bad_alloc.
  void reserve(std::size_t bins);

  /// Counts the points and runs of each of `bins` bins and returns their sum over all bins. Then
  /// sort() must follow.
  Tally count(const ScanRuns& runs, std::size_t chunks, std::uint32_t bins) noexcept;

  /// Calls `place(before, first point, number of points)` for every run in input order; `before` is
  /// the tally of all runs that come before it in the order of bins.
  template <class Place>
  void sort(const ScanRuns& runs, std::size_t chunks, const Place& place) noexcept {
    Tally* const next = tallies_.data();
    runs.for_each(chunks, [&](std::uint32_t bin, std::uint32_t begin, std::uint32_t length) {
      const Tally before = next[bin];
      next[bin].add(Tally::run_of(length));
      place(before, begin, length);
    });
  }

  /// Tally of all bins before `bin`, which can be the number of bins. After sort().
  [[nodiscard]] Tally first(std::uint32_t bin) const noexcept {
    return bin % block_size == 0 ? block_firsts_.data()[bin / block_size] : end(bin - 1);
  }
  /// Tally of all bins up to and including `bin`. After sort().
  [[nodiscard]] Tally end(std::uint32_t bin) const noexcept {
    const std::uint32_t block = bin / block_size;
    return is_empty(block) ? block_firsts_.data()[block] : tallies_.data()[bin];
  }

 private:
  /// Number of bins per block.
  static constexpr std::uint32_t block_size = 16;

  [[nodiscard]] bool is_empty(std::size_t block) const noexcept {
    return block_firsts_.data()[block].word == block_firsts_.data()[block + 1].word;
  }

  std::size_t blocks_ = 0;       ///< number of blocks with reserved memory
  std::size_t used_blocks_ = 0;  ///< number of blocks that the previous scan used
  /// Per bin: at first the tally of the bin, then the tally before its next run, in the end the
  /// tally up to and including the bin. All 0 in blocks without points.
  Buffer<Tally> tallies_;
  Buffer<Tally> block_firsts_;        ///< per block: tally of all bins before it
  Buffer<std::uint8_t> block_marks_;  ///< per block: 1 if it contains points; 0 between scans
};

}  // namespace flagstone::plane_fits
