// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include "library/ground_map/presence_bits.hpp"
#include "library/moving_points/range_image.hpp"

namespace flagstone {
namespace {

constexpr std::size_t columns = PixelGrid::columns;

bool is_possible(NearestPoint nearest, const ObjectRanges& objects) noexcept {
  constexpr auto largest = static_cast<std::uint16_t>(RangeImage::max_range / RangeImage::unit + 1);
  if (nearest.range() > largest) return false;
  const bool has_object = objects.nearest != no_range;
  return has_object ? nearest.range() <= objects.nearest && objects.nearest <= objects.farthest &&
                          objects.farthest <= largest
                    : objects.farthest == 0;
}

}  // namespace

void RangeImage::write(StateWriter& writer) const {
  writer.add(std::int32_t{rows_.first});
  writer.add(std::int32_t{rows_.count});
  for (int row = 0; row < rows_.count; ++row) {
    const std::size_t first = place(rows_.first + row, 0);
    const PresenceBits<columns> measured(
        [&](std::size_t k) { return nearest_[first + k].range() != no_range; });
    measured.write(writer);
    for (std::size_t k = 0; k < columns; ++k) {
      if (!measured[k]) continue;
      writer.add(nearest_[first + k].range());
      writer.add(static_cast<std::uint16_t>(nearest_[first + k].elevation()));
      writer.add(objects_[first + k].nearest);
      writer.add(objects_[first + k].farthest);
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
  clear({.first = first_row, .count = rows});
  for (int row = 0; row < rows_.count; ++row) {
    PresenceBits<columns> measured;
    const std::size_t offset = reader.offset();
    if (!measured.read(reader)) {
      return bad_state(offset, "a row of a range image is incomplete",
                       "one bit per column, then the pixels");
    }
    const std::size_t first = place(rows_.first + row, 0);
    for (std::size_t k = 0; k < columns; ++k) {
      if (!measured[k]) continue;
      const std::size_t offset_of_pixel = reader.offset();
      const auto range = reader.read<std::uint16_t>();
      const NearestPoint nearest(range, reader.read<std::int16_t>());
      nearest_[first + k] = nearest;
      ObjectRanges& objects = objects_[first + k];
      objects.nearest = reader.read<std::uint16_t>();
      objects.farthest = reader.read<std::uint16_t>();
      if (reader.failed() || !is_possible(nearest, objects)) {
        return bad_state(offset_of_pixel, "an impossible pixel of a range image",
                         "ranges up to 650 m, those of objects behind the nearest one");
      }
    }
  }
  repeat_edges();
  return {};
}

}  // namespace flagstone
