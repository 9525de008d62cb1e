// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "library/core/buffer.hpp"

namespace flagstone::plane_fits {

/// Points that one step reads and bins. Threads share a scan by such chunks, and a run's first
/// index and bin fit one word.
inline constexpr std::size_t chunk_size = 8192;

/// Where a run of points in one bin begins: index within the chunk << bin_bits | bin.
using RunStart = std::uint32_t;
inline constexpr int bin_bits =
    18;  ///< bins are 0 to 262,143, those of points without one included
static_assert(chunk_size <= 1U << (32 - bin_bits - 1));  // the index behind the last fits too

/// Consecutive points of a cloud to read, and where to put them.
struct PointSlice {
  CloudView cloud;
  std::size_t begin, end;  ///< at most chunk_size points
  float *x, *y, *z;        ///< of point `begin`; room for 16 more than there are
  RunStart* starts;        ///< room for 17 more
};

/// A scan as the later steps read it: coordinates apart from one another, and where bins change.
///
/// The cloud itself, in whatever layout, is read once, in the order of its memory. A spinning
/// sensor delivers neighbours one after another: 124,000 points are 6 to 9 thousand runs within one
/// bin.
class ScanPoints {
 public:
  /// Makes room for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) {
    const std::size_t chunks = chunk_count(points);
    for (Buffer<float>* coordinate : {&x_, &y_, &z_}) coordinate->reserve(points + 2 * slack);
    starts_.reserve(chunks * (chunk_size + slack) + slack);
    run_counts_.reserve(chunks);
  }

  /// Reads chunk `chunk` of the cloud, which is no larger than reserved: `read_slice(slice)`
  /// does, knowing the bins, and returns how many runs there are; see read_slice-inl.hpp. Chunks
  /// may be read by several threads at once.
  template <class ReadSlice>
  void read(CloudView cloud, std::size_t chunk, const ReadSlice& read_slice) noexcept {
    const std::size_t runs = read_slice(slice(cloud, chunk));
    run_counts_.data()[chunk] = static_cast<std::uint32_t>(runs);
  }

  /// Coordinates, metres, of as many points as have been read; 16 more may be read and are
  /// meaningless.
  [[nodiscard]] const float* x() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y() const noexcept { return y_.data(); }
  [[nodiscard]] const float* z() const noexcept { return z_.data(); }

  /// The runs of a chunk.
  struct Runs {
    const RunStart* starts;  ///< `count` of them, closed by one that begins behind the last point
    std::size_t count;
  };
  [[nodiscard]] Runs runs(std::size_t chunk) const noexcept {
    return {starts_.data() + chunk * (chunk_size + slack), run_counts_.data()[chunk]};
  }

  /// Chunks that a cloud of that size takes.
  static std::size_t chunk_count(std::size_t points) noexcept {
    return (points + chunk_size - 1) / chunk_size;
  }

 private:
  static constexpr std::size_t slack = 16;  ///< what vectors may write behind the last element

  [[nodiscard]] PointSlice slice(CloudView cloud, std::size_t chunk) noexcept {
    const std::size_t begin = chunk * chunk_size;
    return {.cloud = cloud,
            .begin = begin,
            .end = std::min(begin + chunk_size, cloud.size()),
            .x = x_.data() + begin,
            .y = y_.data() + begin,
            .z = z_.data() + begin,
            .starts = starts_.data() + chunk * (chunk_size + slack)};
  }

  Buffer<float> x_;
  Buffer<float> y_;
  Buffer<float> z_;
  Buffer<RunStart> starts_;
  Buffer<std::uint32_t> run_counts_;
};

}  // namespace flagstone::plane_fits
