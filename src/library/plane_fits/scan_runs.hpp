// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "library/core/buffer.hpp"

namespace flagstone::plane_fits {

/// Number of points per chunk. Threads share a scan in chunks. Within a chunk, the first index of a
/// run and its bin fit into one word.
inline constexpr std::size_t chunk_size = 8192;

/// Number of chunks of a cloud with `points` points.
[[nodiscard]] constexpr std::size_t chunk_count(std::size_t points) noexcept {
  return (points + chunk_size - 1) / chunk_size;
}

/// Start of a run of points in one bin: index within the chunk << bin_bits | bin.
using RunStart = std::uint32_t;
/// Bins are 0 to 262,143, including the values for points without a bin.
inline constexpr int bin_bits = 18;
inline constexpr RunStart bin_mask = (1U << bin_bits) - 1;
static_assert(chunk_size <= 1U << (32 - bin_bits - 1));  // the index after the last point also fits

/// The runs of a scan: consecutive points in the same bin.
///
/// A spinning sensor delivers neighbours one after another: 124,000 points have 6,000 to 9,000 runs
/// in the bins of Patchwork.
class ScanRuns {
 public:
  /// Reserves memory for `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) {
    const std::size_t chunks = chunk_count(points);
    starts_.reserve(chunks * (chunk_size + slack) + slack);
    counts_.reserve(chunks);
  }

  /// Where to write the runs of a chunk. 17 more elements than points can be written.
  [[nodiscard]] RunStart* starts(std::size_t chunk) noexcept {
    return starts_.data() + chunk * (chunk_size + slack);
  }
  void set_count(std::size_t chunk, std::size_t runs) noexcept {
    counts_.data()[chunk] = static_cast<std::uint32_t>(runs);
  }

  /// The runs of a chunk, and the index of its first point.
  struct Chunk {
    const RunStart* starts;  ///< `count` runs, then one that begins after the last point
    std::size_t count;
    std::uint32_t first;
  };
  [[nodiscard]] Chunk chunk(std::size_t chunk) const noexcept {
    return {starts_.data() + chunk * (chunk_size + slack), counts_.data()[chunk],
            static_cast<std::uint32_t>(chunk * chunk_size)};
  }

  /// Calls `work(bin, first point, number of points)` for every run of the first `chunks` chunks,
  /// in input order.
  template <class Work>
  void for_each(std::size_t chunks, const Work& work) const {
    for (std::size_t i = 0; i < chunks; ++i) {
      const auto [starts, count, first] = chunk(i);
      for (std::size_t run = 0; run < count; ++run) {
        const std::uint32_t begin = starts[run] >> bin_bits;
        work(starts[run] & bin_mask, first + begin, (starts[run + 1] >> bin_bits) - begin);
      }
    }
  }

 private:
  static constexpr std::size_t slack = 16;  ///< elements that vectors can write after the last one

  Buffer<RunStart> starts_;  ///< per chunk: its runs, then one that begins after its last point
  Buffer<std::uint32_t> counts_;
};

}  // namespace flagstone::plane_fits
