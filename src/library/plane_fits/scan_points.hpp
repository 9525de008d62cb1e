// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "library/core/buffer.hpp"

namespace flagstone::plane_fits {

/// Number of points per chunk. Threads share a scan in chunks. Within a chunk, the first index of a
/// run and its bin fit into one word.
inline constexpr std::size_t chunk_size = 8192;

/// Start of a run of points in one bin: index within the chunk << bin_bits | bin.
using RunStart = std::uint32_t;
/// Bins are 0 to 262,143, including the values for points without a bin.
inline constexpr int bin_bits = 18;
static_assert(chunk_size <= 1U << (32 - bin_bits - 1));  // the index after the last point also fits

/// Consecutive points of a cloud to read, and the destination.
struct PointSlice {
  CloudView cloud;
  std::size_t begin, end;  ///< at most chunk_size points
  float *x, *y, *z;        ///< destination of point `begin`; 16 more elements can be written
  RunStart* starts;        ///< destination of the runs; 17 more elements can be written
};

/// A scan in the form that the later steps read: separate arrays of coordinates, and runs of points
/// in the same bin.
///
/// The cloud, in any layout, is read once, in the order of its memory. A spinning sensor delivers
/// neighbours one after another: 124,000 points have 6,000 to 9,000 runs.
class ScanPoints {
 public:
  /// Reserves memory for `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) {
    const std::size_t chunks = chunk_count(points);
    for (Buffer<float>* coordinate : {&x_, &y_, &z_}) coordinate->reserve(points + 2 * slack);
    starts_.reserve(chunks * (chunk_size + slack) + slack);
    run_counts_.reserve(chunks);
  }

  /// Reads chunk `chunk` of the cloud by `read_slice(slice)`, which returns the number of runs; see
  /// read_slice-inl.hpp. Memory for the cloud must be reserved. Several threads can read different
  /// chunks at once.
  template <class ReadSlice>
  void read(CloudView cloud, std::size_t chunk, const ReadSlice& read_slice) noexcept {
    const std::size_t runs = read_slice(slice(cloud, chunk));
    run_counts_.data()[chunk] = static_cast<std::uint32_t>(runs);
  }

  /// Coordinates of the points, metres. 16 more elements can be read; their values are unspecified.
  [[nodiscard]] const float* x() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y() const noexcept { return y_.data(); }
  [[nodiscard]] const float* z() const noexcept { return z_.data(); }

  /// The runs of a chunk.
  struct Runs {
    const RunStart* starts;  ///< `count` runs, then one that begins after the last point
    std::size_t count;
  };
  [[nodiscard]] Runs runs(std::size_t chunk) const noexcept {
    return {starts_.data() + chunk * (chunk_size + slack), run_counts_.data()[chunk]};
  }

  /// Number of chunks for a cloud with `points` points.
  static std::size_t chunk_count(std::size_t points) noexcept {
    return (points + chunk_size - 1) / chunk_size;
  }

 private:
  static constexpr std::size_t slack = 16;  ///< elements that vectors can write after the last one

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
