// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/tiles.hpp"

#include <algorithm>
#include <cmath>

namespace flagstone {

void CellTiles::remove_beyond(CellIndex centre, double distance) noexcept {
  std::erase_if(tiles_, [&](const auto& tile) {
    constexpr double half = static_cast<double>(tile_width) / 2;
    const double dx = static_cast<double>((tile.first.x << tile_bits) - centre.x) + half;
    const double dy = static_cast<double>((tile.first.y << tile_bits) - centre.y) + half;
    return std::hypot(dx, dy) > distance;
  });
}

std::size_t CellTiles::cells_with_height() const noexcept {
  std::size_t count = 0;
  for (const auto& [index, tile] : tiles_) {
    count += static_cast<std::size_t>(
        std::ranges::count_if(*tile, [](const MapCell& cell) { return cell.best.weight > 0; }));
  }
  return count;
}

std::size_t CellTiles::bytes() const noexcept {
  constexpr std::size_t of_entry = sizeof(Tile) + 64;  // with its node in the table
  return tiles_.size() * of_entry + tiles_.bucket_count() * sizeof(void*);
}

}  // namespace flagstone
