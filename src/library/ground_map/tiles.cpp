// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/tiles.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace flagstone {

void CellTiles::remove_beyond(CellIndex centre, double distance) noexcept {
  std::erase_if(tiles_, [&](const auto& tile) {
    constexpr double half = static_cast<double>(tile_width) / 2;
    const double dx = static_cast<double>((tile.first.x << tile_bits) - centre.x) + half;
    const double dy = static_cast<double>((tile.first.y << tile_bits) - centre.y) + half;
    return std::hypot(dx, dy) > distance;
  });
}

std::vector<TileIndex> CellTiles::least_used(std::size_t kept) const {
  if (tiles_.size() <= kept) return {};
  std::vector<std::tuple<std::uint64_t, std::int64_t, std::int64_t>> uses;
  uses.reserve(tiles_.size());
  for (const auto& [index, entry] : tiles_) uses.emplace_back(entry.last_use, index.y, index.x);
  std::ranges::sort(uses);
  uses.resize(uses.size() - kept);
  std::vector<TileIndex> tiles;
  tiles.reserve(uses.size());
  for (const auto& [use, y, x] : uses) tiles.push_back({.x = x, .y = y});
  return tiles;
}

std::size_t CellTiles::cells_with_height() const noexcept {
  std::size_t count = 0;
  for (const auto& [index, entry] : tiles_) {
    count += static_cast<std::size_t>(std::ranges::count_if(*entry.cells, has_height));
  }
  return count;
}

std::size_t CellTiles::bytes() const noexcept {
  constexpr std::size_t of_entry = sizeof(Tile) + 64;  // with its node in the table
  return tiles_.size() * of_entry + tiles_.bucket_count() * sizeof(void*);
}

}  // namespace flagstone
