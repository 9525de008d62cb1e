// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "flagstone/cloud_view.hpp"
#include "library/core/buffer.hpp"

namespace flagstone {

/// Points as three arrays, for vector instructions. The memory after the last point is readable up
/// to a multiple of `padding` points.
class PointArrays {
 public:
  static constexpr std::size_t padding = 16;

  /// Removes all points and reserves memory for `count`. May throw std::bad_alloc.
  void start(std::size_t count) {
    const std::size_t padded = (count + padding - 1) / padding * padding;
    for (Buffer<float>* array : {&x_, &y_, &z_}) array->reserve(padded);
    size_ = 0;
  }
  /// Sets the number of points. Their coordinates are unspecified. May throw std::bad_alloc.
  void resize(std::size_t count) {
    start(count);
    size_ = count;
  }
  void push_back(const Point& point) noexcept {
    x_.data()[size_] = point.x;
    y_.data()[size_] = point.y;
    z_.data()[size_] = point.z;
    ++size_;
  }
  void replace(std::size_t k, const Point& point) noexcept {
    x_.data()[k] = point.x;
    y_.data()[k] = point.y;
    z_.data()[k] = point.z;
  }
  /// Keeps the first `count` points.
  void shorten(std::size_t count) noexcept {
    size_ = count;
    finish();
  }
  /// Sets the unused numbers after the last point to 0.
  void finish() noexcept {
    for (std::size_t k = size_; k % padding != 0; ++k) {
      x_.data()[k] = y_.data()[k] = z_.data()[k] = 0;
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] Point operator[](std::size_t k) const noexcept {
    return {.x = x()[k], .y = y()[k], .z = z()[k]};
  }
  [[nodiscard]] const float* x() const noexcept { return x_.data(); }
  [[nodiscard]] const float* y() const noexcept { return y_.data(); }
  [[nodiscard]] const float* z() const noexcept { return z_.data(); }
  [[nodiscard]] float* x() noexcept { return x_.data(); }
  [[nodiscard]] float* y() noexcept { return y_.data(); }
  [[nodiscard]] float* z() noexcept { return z_.data(); }

 private:
  Buffer<float> x_, y_, z_;
  std::size_t size_ = 0;
};

/// A transform of points: three rows of a matrix, each followed by an offset.
using AffineTransform = std::array<float, 12>;

inline constexpr AffineTransform identity_transform{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/// The pixels of range images, by direction: columns of about 0.35 degrees, rows of one beam
/// spacing.
struct PixelGrid {
  static constexpr int columns = 1029;

  float rows_per_radian = 0;
};

/// Where a sensor sees points: a pixel and a range per point.
class Directions {
 public:
  /// Transforms points to the frame of the sensor and computes their directions. The same on every
  /// instruction set. Points may have any coordinates; if they are not finite, the results are
  /// unspecified. May throw std::bad_alloc.
  void compute(const PointArrays& points, const AffineTransform& transform, const PixelGrid& grid);

  /// @name One number per point, for vector instructions
  /// The memory after the last number is readable up to a multiple of PointArrays::padding.
  /// @{
  [[nodiscard]] const std::int32_t* rows() const noexcept { return rows_.data(); }
  [[nodiscard]] const std::int32_t* columns() const noexcept { return columns_.data(); }
  [[nodiscard]] const float* ranges() const noexcept { return ranges_.data(); }
  [[nodiscard]] const float* elevations() const noexcept { return elevations_.data(); }
  /// @}

  [[nodiscard]] int row(std::size_t k) const noexcept { return rows_.data()[k]; }
  /// 0 to PixelGrid::columns - 1.
  [[nodiscard]] int column(std::size_t k) const noexcept { return columns_.data()[k]; }
  [[nodiscard]] float range(std::size_t k) const noexcept { return ranges_.data()[k]; }  ///< metres
  /// Above the horizontal plane of the sensor, radians.
  [[nodiscard]] float elevation(std::size_t k) const noexcept { return elevations_.data()[k]; }

 private:
  Buffer<std::int32_t> rows_, columns_;
  Buffer<float> ranges_, elevations_;
};

}  // namespace flagstone
