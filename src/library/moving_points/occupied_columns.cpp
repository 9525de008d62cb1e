// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/occupied_columns.hpp"

#include <cmath>
#include <limits>

namespace flagstone {

TileIndex OccupiedColumns::tile_of(std::int64_t x, std::int64_t y) noexcept {
  const auto index = [](std::int64_t column) {
    return (column - (column & (tile_width - 1))) / tile_width;  // rounds down
  };
  return {.x = index(x), .y = index(y)};
}

std::size_t OccupiedColumns::index_in_tile(std::int64_t x, std::int64_t y) noexcept {
  constexpr std::int64_t mask = tile_width - 1;
  return static_cast<std::size_t>((y & mask) * tile_width + (x & mask));
}

void OccupiedColumns::start(double x, double y) {
  seen_.assign(static_cast<std::size_t>(scan_width * scan_width), 0);
  x_ = x;
  y_ = y;
  first_x_ = static_cast<std::int64_t>(std::floor(x / width)) - scan_width / 2;
  first_y_ = static_cast<std::int64_t>(std::floor(y / width)) - scan_width / 2;
}

void OccupiedColumns::finish() {
  const TileIndex first = tile_of(first_x_, first_y_);
  const TileIndex last = tile_of(first_x_ + scan_width - 1, first_y_ + scan_width - 1);
  for (std::int64_t y = first.y; y <= last.y; ++y) {
    for (std::int64_t x = first.x; x <= last.x; ++x) {
      std::unique_ptr<Tile>& tile = tiles_[{.x = x, .y = y}];
      if (!tile) tile = std::make_unique<Tile>();
    }
  }
  for (std::int64_t row = 0; row < scan_width; ++row) {
    for (std::int64_t column = 0; column < scan_width; ++column) {
      const std::uint8_t seen = seen_[static_cast<std::size_t>(row * scan_width + column)];
      if (seen == 0) continue;
      const std::int64_t x = first_x_ + column;
      const std::int64_t y = first_y_ + row;
      Counts& counts = (*tiles_.find(tile_of(x, y))->second)[index_in_tile(x, y)];
      std::uint16_t& count = (seen & 2U) != 0 ? counts.occupied : counts.empty;
      if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
    }
  }
}

bool OccupiedColumns::is_occupied(double x, double y) const noexcept {
  constexpr unsigned min_scans = 4;
  constexpr double min_fraction = 0.9;
  const auto column = static_cast<std::int64_t>(std::floor(x / width));
  const auto row = static_cast<std::int64_t>(std::floor(y / width));
  const auto tile = tiles_.find(tile_of(column, row));
  if (tile == tiles_.end()) return false;
  const Counts& counts = (*tile->second)[index_in_tile(column, row)];
  return counts.occupied >= min_scans &&
         counts.occupied > min_fraction * (counts.occupied + counts.empty);
}

void OccupiedColumns::forget_beyond(double x, double y, double distance) noexcept {
  std::erase_if(tiles_, [&](const auto& tile) {
    const auto centre = [](std::int64_t index) {
      return (static_cast<double>(index) + 0.5) * tile_width * width;
    };
    return std::hypot(centre(tile.first.x) - x, centre(tile.first.y) - y) > distance;
  });
}

std::size_t OccupiedColumns::bytes() const noexcept {
  constexpr std::size_t of_entry = sizeof(Tile) + 64;  // with its node in the table
  return tiles_.size() * of_entry + seen_.capacity();
}

}  // namespace flagstone
