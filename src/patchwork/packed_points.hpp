// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "core/buffer.hpp"
#include "flagstone/cloud_view.hpp"
#include "patchwork/bin_runs.hpp"

namespace flagstone::patchwork {

/// The points of one bin, packed: x[0..n), y[0..n), z[0..n), so that every pass of the fit reads
/// contiguous memory. They are in the order of the bin's runs.
class PackedPoints {
 public:
  /// Makes room for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points) {
    capacity_ = points > capacity_ ? points : capacity_;
    coordinates_.reserve(3 * capacity_);
  }

  /// Reads the points of these runs from the cloud.
  void gather(CloudView cloud, std::span<const Run> runs) noexcept {
    std::size_t n = 0;
    float* x = coordinates_.data();
    float* y = x + capacity_;
    float* z = y + capacity_;
    for (const Run& run : runs) {
      for (std::uint32_t i = run.begin; i < run.begin + run.length; ++i, ++n) {
        const Point p = cloud[i];
        x[n] = p.x;
        y[n] = p.y;
        z[n] = p.z;
      }
    }
    size_ = n;
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::span<const float> x() const noexcept { return {coordinates_.data(), size_}; }
  [[nodiscard]] std::span<const float> y() const noexcept {
    return {coordinates_.data() + capacity_, size_};
  }
  [[nodiscard]] std::span<const float> z() const noexcept {
    return {coordinates_.data() + 2 * capacity_, size_};
  }

 private:
  Buffer<float> coordinates_;
  std::size_t capacity_ = 0;
  std::size_t size_ = 0;
};

}  // namespace flagstone::patchwork
