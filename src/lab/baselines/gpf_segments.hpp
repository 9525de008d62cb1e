// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lab/baselines/coordinates.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/buffer.hpp"

namespace flagstone::baselines {

/// The points of a scan sorted into segments along x, rearmost segment first, in input order within
/// each segment.
class GpfSegments {
 public:
  /// `count` segments of `length` metres, half of them on either side of x = 0. The first and the
  /// last segment are open-ended.
  GpfSegments(int count, float length);

  /// Reserves memory for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Sorts the points into the segments.
  void sort(const UsablePoints& points) noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  /// Segment of a point, 0 to count() - 1. Points on a boundary belong to the segment in front of
  /// it.
  [[nodiscard]] int segment_of(float x) const noexcept;
  /// The points of a segment.
  [[nodiscard]] Coordinates points(int segment) const noexcept;
  /// Index in the cloud of each point of a segment.
  [[nodiscard]] std::span<const std::uint32_t> index(int segment) const noexcept;

 private:
  [[nodiscard]] std::size_t begin(int segment) const noexcept {
    return ends_[static_cast<std::size_t>(segment)];
  }
  [[nodiscard]] std::size_t size(int segment) const noexcept {
    return ends_[static_cast<std::size_t>(segment) + 1] - begin(segment);
  }

  int count_;
  float length_;
  std::vector<std::size_t> ends_;  // index of the first point of each segment, and the end
  std::vector<std::size_t> next_;  // index for the next point of each segment
  Buffer<float> x_, y_, z_;
  Buffer<std::uint32_t> index_;
};

}  // namespace flagstone::baselines
