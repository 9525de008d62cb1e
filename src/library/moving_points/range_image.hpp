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

/// The ranges that one scan measured in one direction, in units of RangeImage::unit.
struct RangePixel {
  static constexpr std::uint16_t nothing = std::numeric_limits<std::uint16_t>::max();

  std::uint16_t nearest = nothing;  ///< of all points
  std::int16_t elevation = 0;       ///< of that point, in units of RangeImage::elevation_unit
  /// @name Points of static objects
  /// @{
  std::uint16_t nearest_object = nothing;
  std::uint16_t farthest_object = 0;  ///< 0: no such point
  /// @}
};

/// Ranges of one scan, by direction.
class RangeImage {
 public:
  static constexpr float unit = 0.01F;              ///< metres
  static constexpr float elevation_unit = 0.0001F;  ///< radians
  static constexpr float max_range = 650;           ///< metres; points beyond are omitted

  /// Fills the image from the directions of `is_object.size()` points. `is_object`: 1 for points of
  /// static objects, 0 for ground and moving points. The order of the points does not matter. May
  /// throw std::bad_alloc.
  void build(const Directions& directions, std::span<const std::uint8_t> is_object);

  /// The pixel in a column, 0 to PixelGrid::columns - 1, of any row. The pixels to the left and
  /// right follow in memory, those above and below at a distance of `stride`.
  [[nodiscard]] const RangePixel* pixel(int row, int column) const noexcept {
    const int k = std::clamp(row - first_row_, -empty_rows + 1, rows_ + empty_rows - 2);
    return pixels_.data() + static_cast<std::ptrdiff_t>(k + empty_rows) * stride + column + 1;
  }

  /// Pixels per row: column -1 repeats the last one, and another one after the last column repeats
  /// the first one.
  static constexpr std::ptrdiff_t stride = PixelGrid::columns + 2;

  /// Appends the image to a state. May throw std::bad_alloc.
  void write(StateWriter& writer) const;

  /// Reads the image of a state. bad_file if it is damaged; the image is then unspecified. May
  /// throw std::bad_alloc.
  Status read(StateReader& reader);

  [[nodiscard]] std::size_t bytes() const noexcept {
    return pixels_.capacity() * sizeof(RangePixel);
  }

 private:
  static constexpr int empty_rows = 3;  // below and above: their neighbours exist, too

  void repeat_edges() noexcept;  // columns -1 and PixelGrid::columns

  std::vector<RangePixel> pixels_ = std::vector<RangePixel>(std::size_t{2} * empty_rows * stride);
  int first_row_ = 0;
  int rows_ = 0;
};

}  // namespace flagstone
