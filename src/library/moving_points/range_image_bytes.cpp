// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "library/ground_map/presence_bits.hpp"
#include "library/moving_points/range_image.hpp"

namespace flagstone {
namespace {

constexpr std::size_t columns = PixelGrid::columns;

bool is_measured(const RangePixel& pixel) noexcept { return pixel.nearest != RangePixel::nothing; }

bool is_possible(const RangePixel& pixel) noexcept {
  constexpr auto largest = static_cast<std::uint16_t>(RangeImage::max_range / RangeImage::unit + 1);
  if (pixel.nearest > largest) return false;
  const bool has_object = pixel.nearest_object != RangePixel::nothing;
  return has_object
             ? pixel.nearest <= pixel.nearest_object &&
                   pixel.nearest_object <= pixel.farthest_object && pixel.farthest_object <= largest
             : pixel.farthest_object == 0;
}

}  // namespace

void RangeImage::write(StateWriter& writer) const {
  writer.add(std::int32_t{first_row_});
  writer.add(std::int32_t{rows_});
  for (int row = 0; row < rows_; ++row) {
    const RangePixel* const pixels = pixel(first_row_ + row, 0);
    const PresenceBits<columns> measured([&](std::size_t k) { return is_measured(pixels[k]); });
    measured.write(writer);
    for (std::size_t k = 0; k < columns; ++k) {
      if (!measured[k]) continue;
      writer.add(pixels[k].nearest);
      writer.add(static_cast<std::uint16_t>(pixels[k].elevation));
      writer.add(pixels[k].nearest_object);
      writer.add(pixels[k].farthest_object);
    }
  }
}

Status RangeImage::read(StateReader& reader) {
  constexpr std::int32_t max_row = 1000;  // above 90 degrees of the smallest beam spacing
  const std::size_t begin = reader.offset();
  const auto first_row = reader.read<std::int32_t>();
  const auto rows = reader.read<std::int32_t>();
  if (reader.failed() || first_row < -max_row || first_row > max_row || rows < 0 ||
      rows > max_row - first_row ||
      static_cast<std::size_t>(rows) > reader.left() / PresenceBits<columns>::bytes) {
    return bad_state(begin, "the rows of a range image are impossible",
                     "rows from -1000 to 999, and their pixels");
  }
  first_row_ = first_row;
  rows_ = rows;
  pixels_.assign(static_cast<std::size_t>(rows_ + 2 * empty_rows) * stride, RangePixel{});
  for (int row = 0; row < rows_; ++row) {
    PresenceBits<columns> measured;
    const std::size_t offset = reader.offset();
    if (!measured.read(reader)) {
      return bad_state(offset, "a row of a range image is incomplete",
                       "one bit per column, then the pixels");
    }
    RangePixel* const pixels = pixels_.data() + (row + empty_rows) * stride + 1;
    for (std::size_t k = 0; k < columns; ++k) {
      if (!measured[k]) continue;
      const std::size_t offset_of_pixel = reader.offset();
      RangePixel& pixel = pixels[k];
      pixel.nearest = reader.read<std::uint16_t>();
      pixel.elevation = reader.read<std::int16_t>();
      pixel.nearest_object = reader.read<std::uint16_t>();
      pixel.farthest_object = reader.read<std::uint16_t>();
      if (reader.failed() || !is_possible(pixel)) {
        return bad_state(offset_of_pixel, "an impossible pixel of a range image",
                         "ranges up to 650 m, those of objects behind the nearest one");
      }
    }
  }
  repeat_edges();
  return {};
}

}  // namespace flagstone
