// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/range_image.hpp"

#include <limits>

namespace flagstone {

void RangeImage::build(const Directions& directions, std::span<const std::uint8_t> is_object) {
  const auto is_used = [&](std::size_t k) {
    return directions.range(k) > 0 && directions.range(k) < max_range;
  };
  int lowest = std::numeric_limits<int>::max();
  int highest = std::numeric_limits<int>::min();
  for (std::size_t k = 0; k < is_object.size(); ++k) {
    if (!is_used(k)) continue;
    lowest = std::min(lowest, directions.row(k));
    highest = std::max(highest, directions.row(k));
  }
  first_row_ = lowest <= highest ? lowest : 0;
  rows_ = lowest <= highest ? highest - lowest + 1 : 0;
  pixels_.assign(static_cast<std::size_t>(rows_ + 2 * empty_rows) * stride, RangePixel{});
  RangePixel* const first = pixels_.data() + empty_rows * stride + 1;
  for (std::size_t k = 0; k < is_object.size(); ++k) {
    if (!is_used(k)) continue;
    RangePixel& pixel = first[(directions.row(k) - first_row_) * stride + directions.column(k)];
    const auto range = static_cast<std::uint16_t>(directions.range(k) * (1 / unit));
    const auto elevation =
        static_cast<std::int16_t>(directions.elevation(k) * (1 / elevation_unit));
    if (range < pixel.nearest || (range == pixel.nearest && elevation < pixel.elevation)) {
      pixel.nearest = range;
      pixel.elevation = elevation;
    }
    if (is_object[k] != 0) {
      pixel.nearest_object = std::min(pixel.nearest_object, range);
      pixel.farthest_object = std::max(pixel.farthest_object, range);
    }
  }
  repeat_edges();
}

void RangeImage::repeat_edges() noexcept {
  for (int row = 0; row < rows_; ++row) {
    RangePixel* const pixels = pixels_.data() + (row + empty_rows) * stride + 1;
    pixels[-1] = pixels[PixelGrid::columns - 1];
    pixels[PixelGrid::columns] = pixels[0];
  }
}

}  // namespace flagstone
