// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "library/ground_map/state_bytes.hpp"
#include "library/moving_points/directions.hpp"

namespace flagstone {

/// A range of RangeImage that was not measured, in its units.
inline constexpr std::uint16_t no_range = std::numeric_limits<std::uint16_t>::max();

/// The nearest point of any kind in one direction, as one number that orders them: by range, then
/// by elevation.
class NearestPoint {
 public:
  NearestPoint() = default;  ///< no point
  NearestPoint(std::uint16_t range, std::int16_t elevation) noexcept
      : key_(std::uint32_t{range} << 16U | static_cast<std::uint16_t>(elevation - lowest)) {}

  /// In units of RangeImage::unit; `no_range` if nothing was measured.
  [[nodiscard]] std::uint16_t range() const noexcept {
    return static_cast<std::uint16_t>(key_ >> 16U);
  }
  /// In units of RangeImage::elevation_unit.
  [[nodiscard]] std::int16_t elevation() const noexcept {
    return static_cast<std::int16_t>(static_cast<std::int32_t>(key_ & 0xFFFFU) + lowest);
  }

  friend auto operator<=>(NearestPoint, NearestPoint) = default;

 private:
  static constexpr std::int32_t lowest = std::numeric_limits<std::int16_t>::min();

  std::uint32_t key_ = ~std::uint32_t{0};
};

/// The ranges of static objects in one direction, in units of RangeImage::unit.
struct ObjectRanges {
  std::uint16_t nearest = no_range;
  std::uint16_t farthest = 0;  ///< 0: no object
};

/// The rows of an image that have points.
struct ImageRows {
  int first = 0;
  int count = 0;

  /// Number of empty rows below and above them, which also have neighbours.
  static constexpr int empty = 3;
  [[nodiscard]] int in_memory() const noexcept { return count + 2 * empty; }
};

/// Ranges of one scan, by direction.
class RangeImage {
 public:
  static constexpr float unit = 0.01F;              ///< metres
  static constexpr float elevation_unit = 0.0001F;  ///< radians
  static constexpr float max_range = 650;           ///< metres; points beyond are omitted

  /// Fills the image from the directions of `is_object.size()` points. `is_object`: 1 for points of
  /// static objects, 0 for ground and moving points. Points at the sensor are omitted. The order of
  /// the points does not matter. May throw std::bad_alloc.
  void build(const Directions& directions, std::span<const std::uint8_t> is_object);

  /// The place of a pixel in the arrays of nearest points and objects: of a column, 0 to
  /// PixelGrid::columns - 1, and any row. The pixels to the left and right follow in memory, those
  /// above and below at a distance of `stride`, and at least one more after all of them.
  [[nodiscard]] std::size_t place(int row, int column) const noexcept {
    const int k = std::clamp(row - rows_.first + ImageRows::empty, 1, rows_.in_memory() - 2);
    return static_cast<std::size_t>(k * stride + column + 1);
  }
  [[nodiscard]] const ImageRows& rows() const noexcept { return rows_; }
  [[nodiscard]] const NearestPoint* nearest() const noexcept { return nearest_.data(); }
  [[nodiscard]] const ObjectRanges* objects() const noexcept { return objects_.data(); }

  /// Pixels per row: column -1 repeats the last one, and another one after the last column repeats
  /// the first one.
  static constexpr std::ptrdiff_t stride = PixelGrid::columns + 2;

  /// Appends the image to a state. May throw std::bad_alloc.
  void write(StateWriter& writer) const;

  /// Reads the image of a state. bad_file if it is damaged; the image is then unspecified. May
  /// throw std::bad_alloc.
  Status read(StateReader& reader);

  [[nodiscard]] std::size_t bytes() const noexcept {
    return nearest_.capacity() * sizeof(NearestPoint) + objects_.capacity() * sizeof(ObjectRanges);
  }

 private:
  void clear(const ImageRows& rows);
  void repeat_edges() noexcept;  // columns -1 and PixelGrid::columns

  static constexpr std::size_t empty_size = std::size_t{2} * ImageRows::empty * stride;

  std::vector<NearestPoint> nearest_ = std::vector<NearestPoint>(empty_size);
  std::vector<ObjectRanges> objects_ = std::vector<ObjectRanges>(empty_size);
  ImageRows rows_;
};

}  // namespace flagstone
