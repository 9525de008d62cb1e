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

/// The points of a scan, segment by segment along x, rearmost segment first; within a segment in
/// input order.
class GpfSegments {
 public:
  /// Segments of `length` metres, half of `count` on either side of x = 0; the first and the last
  /// are open to the outside.
  GpfSegments(int count, float length);

  /// Makes room for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Takes the points in.
  void sort(const UsablePoints& points) noexcept;

  [[nodiscard]] int count() const noexcept { return count_; }
  /// Which segment a point belongs to, 0 to count() - 1. A point on a boundary is of the front one.
  [[nodiscard]] int segment_of(float x) const noexcept;
  /// The points of a segment.
  [[nodiscard]] Coordinates points(int segment) const noexcept;
  /// Index in the cloud of each of them.
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
  std::vector<std::size_t> ends_;  // of the segment before: where each segment begins, and the end
  std::vector<std::size_t> next_;  // where the next point of each segment goes
  Buffer<float> x_, y_, z_;
  Buffer<std::uint32_t> index_;
};

}  // namespace flagstone::baselines
