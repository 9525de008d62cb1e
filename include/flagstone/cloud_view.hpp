// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>

namespace flagstone {

/// One point in the sensor frame: metres, x forward, y left, z up, origin at the sensor.
struct Point {
  float x;  ///< metres, forward
  float y;  ///< metres, to the left
  float z;  ///< metres, up
};

/// Memory layout of a cloud. The address of a coordinate of point i is `data + i * stride +
/// offset`, in bytes, with any alignment. Offsets may exceed the stride, so planar storage works
/// too: N x values, then N y values, then N z values have the layout {4, 0, 4 * N, 8 * N}.
struct CloudLayout {
  std::ptrdiff_t stride;  ///< distance between consecutive points, bytes
  std::ptrdiff_t x;       ///< offset of x, bytes
  std::ptrdiff_t y;       ///< offset of y, bytes
  std::ptrdiff_t z;       ///< offset of z, bytes
};

/// A point struct with float members x, y and z, such as the point types of PCL.
template <class T>
concept XyzPoint = std::is_standard_layout_v<T> && requires(const T& point) {
  requires std::same_as<std::remove_cvref_t<decltype(point.x)>, float>;
  requires std::same_as<std::remove_cvref_t<decltype(point.y)>, float>;
  requires std::same_as<std::remove_cvref_t<decltype(point.z)>, float>;
};

/// A zero-copy view of a point cloud: pointer, number of points and layout.
///
/// The memory must outlive the view and must not change while a segmenter reads it. A view can be
/// read from several threads at once.
class CloudView {
 public:
  /// An empty cloud.
  constexpr CloudView() noexcept = default;

  /// A cloud of `count` points with `floats_per_point` 32-bit floats each, starting with x, y and
  /// z: 3 for packed xyz, 4 for KITTI (x, y, z, intensity), 5 for nuScenes (with ring).
  constexpr CloudView(const float* points, std::size_t count,
                      std::size_t floats_per_point = 3) noexcept
      : data_(points),
        count_(count),
        layout_{static_cast<std::ptrdiff_t>(floats_per_point * sizeof(float)), 0, sizeof(float),
                2 * sizeof(float)} {}

  /// A cloud of `count` points with any other layout: a PointCloud2-like blob, a column-major
  /// matrix, a strided array.
  constexpr CloudView(const void* data, std::size_t count, CloudLayout layout) noexcept
      : data_(data), count_(count), layout_(layout) {}

  /// A cloud of contiguous structs with float members x, y and z.
  template <XyzPoint T>
  explicit CloudView(std::span<const T> points) noexcept
      : data_(points.data()), count_(points.size()), layout_{sizeof(T), 0, 0, 0} {
    if (!points.empty()) {
      const auto* base = reinterpret_cast<const std::byte*>(points.data());
      layout_.x = reinterpret_cast<const std::byte*>(&points[0].x) - base;
      layout_.y = reinterpret_cast<const std::byte*>(&points[0].y) - base;
      layout_.z = reinterpret_cast<const std::byte*>(&points[0].z) - base;
    }
  }

  /// Number of points.
  [[nodiscard]] constexpr std::size_t size() const noexcept { return count_; }
  /// True if the cloud has no points.
  [[nodiscard]] constexpr bool empty() const noexcept { return count_ == 0; }
  /// The address that the offsets of the layout start from.
  [[nodiscard]] constexpr const void* data() const noexcept { return data_; }
  /// The layout of the coordinates in memory.
  [[nodiscard]] constexpr const CloudLayout& layout() const noexcept { return layout_; }

  /// Point `i`, which must be less than size(). The index is not checked.
  [[nodiscard]] Point operator[](std::size_t i) const noexcept {
    const std::byte* p =
        static_cast<const std::byte*>(data_) + static_cast<std::ptrdiff_t>(i) * layout_.stride;
    return {load(p + layout_.x), load(p + layout_.y), load(p + layout_.z)};
  }

 private:
  static float load(const std::byte* p) noexcept {
    float value;
    std::memcpy(&value, p, sizeof value);  // any alignment
    return value;
  }

  const void* data_ = nullptr;
  std::size_t count_ = 0;
  CloudLayout layout_{3 * sizeof(float), 0, sizeof(float), 2 * sizeof(float)};
};

}  // namespace flagstone
