// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "flagstone/cloud_view.hpp"
#include "library/core/buffer.hpp"
#include "library/plane_fits/scan_runs.hpp"

namespace flagstone::plane_fits {

/// Consecutive points of a cloud to read, and the destination.
struct PointSlice {
  CloudView cloud;
  std::size_t begin, end;  ///< at most chunk_size points
  float *x, *y, *z;        ///< destination of point `begin`; 16 more elements can be written
  RunStart* starts;        ///< destination of the runs; 17 more elements can be written
};

/// A scan in the form that the later steps of Patchwork read: separate arrays of coordinates, and
/// runs of points in the same bin. The cloud, in any layout, is read once, in the order of its
/// memory.
class ScanPoints {
 public:
  /// Reserves memory for `points` points. May throw std::bad_alloc.
  void reserve(std::size_t points) {
    for (Buffer<float>* coordinate : {&x_, &y_, &z_}) coordinate->reserve(points + 2 * slack);
    runs_.reserve(points);
  }

  /// Reads chunk `chunk` of the cloud by `read_slice(slice)`, which returns the number of runs; see
  /// read_slice-inl.hpp. Memory for the cloud must be reserved. Several threads can read different
  /// chunks at once.
  template <class ReadSlice>
  void read(CloudView cloud, std::size_t chunk, const ReadSlice& read_slice) noexcept {
    runs_.set_count(chunk, read_slice(slice(cloud, chunk)));
  }

  /// Coordinates of the points, metres. 16 more elements can be read; their values are unspecified.
  [[nodiscard]] const float* x() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y() const noexcept { return y_.data(); }
  [[nodiscard]] const float* z() const noexcept { return z_.data(); }

  [[nodiscard]] const ScanRuns& runs() const noexcept { return runs_; }

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
            .starts = runs_.starts(chunk)};
  }

  Buffer<float> x_;
  Buffer<float> y_;
  Buffer<float> z_;
  ScanRuns runs_;
};

}  // namespace flagstone::plane_fits
