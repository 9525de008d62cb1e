// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/range_image.hpp"

#include <limits>

namespace flagstone {

void RangeImage::clear(int first_row, int rows) {
  first_row_ = first_row;
  rows_ = rows;
  const auto pixels = static_cast<std::size_t>((rows_ + 2 * empty_rows) * stride);
  nearest_.assign(pixels, {});
  objects_.assign(pixels, {});
}

void RangeImage::build(const Directions& directions, std::span<const std::uint8_t> is_object) {
  const auto is_used = [&](std::size_t k) {
    return directions.range(k) > 0 && directions.range(k) < max_range;
  };
  int lowest = std::numeric_limits<int>::max();
  int highest = std::numeric_limits<int>::min();
  for (std::size_t k = 0; k < is_object.size(); ++k) {
    const int row = directions.row(k);
    lowest = is_used(k) ? std::min(lowest, row) : lowest;
    highest = is_used(k) ? std::max(highest, row) : highest;
  }
  clear(lowest <= highest ? lowest : 0, lowest <= highest ? highest - lowest + 1 : 0);
  for (std::size_t k = 0; k < is_object.size(); ++k) {
    if (!is_used(k)) continue;
    const std::size_t pixel = place(directions.row(k), directions.column(k));
    const auto range = static_cast<std::uint16_t>(directions.range(k) * (1 / unit));
    const auto elevation =
        static_cast<std::int16_t>(directions.elevation(k) * (1 / elevation_unit));
    nearest_[pixel] = std::min(nearest_[pixel], NearestPoint(range, elevation));
    ObjectRanges& objects = objects_[pixel];
    objects.nearest = std::min(objects.nearest, is_object[k] != 0 ? range : no_range);
    objects.farthest = std::max(objects.farthest, is_object[k] != 0 ? range : std::uint16_t{0});
  }
  repeat_edges();
}

void RangeImage::repeat_edges() noexcept {
  for (int row = 0; row < rows_; ++row) {
    const auto repeat = [&](auto& pixels) {
      auto* const first = pixels.data() + (row + empty_rows) * stride + 1;
      first[-1] = first[PixelGrid::columns - 1];
      first[PixelGrid::columns] = first[0];
    };
    repeat(nearest_);
    repeat(objects_);
  }
}

}  // namespace flagstone
