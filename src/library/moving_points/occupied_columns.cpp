// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/occupied_columns.hpp"

#include <algorithm>
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

OccupiedColumns::Window::Window(double x, double y, std::uint32_t columns) noexcept
    : first_x(static_cast<std::int64_t>(std::floor(x / width)) - columns / 2),
      first_y(static_cast<std::int64_t>(std::floor(y / width)) - columns / 2),
      grid{.offset_x = static_cast<float>(x - static_cast<double>(first_x) * width),
           .offset_y = static_cast<float>(y - static_cast<double>(first_y) * width),
           .per_metre = static_cast<float>(1 / width),
           .width = columns} {}

void OccupiedColumns::start(double x, double y) {
  scan_ = Window(x, y, scan_width);
  seen_.assign(2 * (std::size_t{scan_.grid.outside()} + 1), 0);
}

void OccupiedColumns::finish() {
  const TileIndex first = tile_of(scan_.first_x, scan_.first_y);
  const TileIndex last = tile_of(scan_.first_x + scan_width - 1, scan_.first_y + scan_width - 1);
  for (std::int64_t y = first.y; y <= last.y; ++y) {
    for (std::int64_t x = first.x; x <= last.x; ++x) {
      std::unique_ptr<Tile>& tile = tiles_[{.x = x, .y = y}];
      if (!tile) tile = std::make_unique<Tile>();
    }
  }
  for (std::int64_t row = 0; row < scan_width; ++row) {
    TileIndex index;
    Tile* tile = nullptr;
    for (std::int64_t column = 0; column < scan_width; ++column) {
      const std::uint8_t* const seen =
          &seen_[static_cast<std::size_t>(2 * (row * scan_width + column))];
      const bool has_ground = seen[0] != 0;
      const bool has_object = seen[1] != 0;
      if (!has_ground && !has_object) continue;
      const std::int64_t x = scan_.first_x + column;
      const std::int64_t y = scan_.first_y + row;
      if (tile == nullptr || !(index == tile_of(x, y))) {
        index = tile_of(x, y);
        tile = tiles_.find(index)->second.get();
      }
      Counts& counts = (*tile)[index_in_tile(x, y)];
      std::uint16_t& count = has_object ? counts.occupied : counts.empty;
      if (count < std::numeric_limits<std::uint16_t>::max()) ++count;
    }
  }
}

// The columns of the window, tile by tile.
void OccupiedColumns::look_around(double x, double y) {
  constexpr unsigned min_scans = 4;
  constexpr unsigned min_ratio = 9;  // of scans with an object to scans without one
  around_ = Window(x, y, window_width);
  occupied_.assign(around_.grid.outside() + 1, 0);
  const std::int64_t end_x = around_.first_x + window_width;
  const std::int64_t end_y = around_.first_y + window_width;
  std::int64_t next_y = 0;
  for (std::int64_t y0 = around_.first_y; y0 < end_y; y0 = next_y) {
    next_y = std::min(end_y, (tile_of(0, y0).y + 1) * tile_width);
    std::int64_t next_x = 0;
    for (std::int64_t x0 = around_.first_x; x0 < end_x; x0 = next_x) {
      next_x = std::min(end_x, (tile_of(x0, 0).x + 1) * tile_width);
      const auto tile = tiles_.find(tile_of(x0, y0));
      if (tile == tiles_.end()) continue;
      for (std::int64_t row = y0; row < next_y; ++row) {
        const Counts* const counts = tile->second->data() + index_in_tile(x0, row);
        std::uint8_t* const to =
            occupied_.data() + (row - around_.first_y) * window_width + (x0 - around_.first_x);
        for (std::int64_t k = 0; k < next_x - x0; ++k) {
          const unsigned occupied = counts[k].occupied;
          to[k] = occupied >= min_scans && occupied > min_ratio * counts[k].empty ? 1 : 0;
        }
      }
    }
  }
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
  return tiles_.size() * of_entry + seen_.capacity() + occupied_.capacity();
}

}  // namespace flagstone
