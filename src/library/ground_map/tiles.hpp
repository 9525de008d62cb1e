// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/tile_index_hash.hpp"

namespace flagstone {

/// Index of a cell of the world: floor(x / cell), floor(y / cell).
struct CellIndex {
  std::int64_t x = 0, y = 0;

  friend bool operator==(CellIndex, CellIndex) = default;
};

/// A height with the evidence for it.
struct HeightEvidence {
  float height = 0;         ///< metres above the base of the map
  float weight = 0;         ///< sum of 1 / variance, 1/m^2; 0: no height
  float scatter = 0;        ///< sum of squared differences from the height, each / variance
  std::uint16_t scans = 0;  ///< saturates

  /// Adds a measurement by its weight.
  void add(float measured, float its_weight) noexcept {
    weight += its_weight;
    const float difference = measured - height;
    height += its_weight / weight * difference;
    scatter += its_weight * difference * (measured - height);
    if (scans < std::numeric_limits<std::uint16_t>::max()) ++scans;
  }
};

/// A cell: the height with the most evidence, and another one that contradicts it.
struct MapCell {
  HeightEvidence best, other;
  std::uint32_t last_scan = 0;  ///< number of the scan that measured the cell last
};

inline bool has_height(const MapCell& cell) noexcept { return cell.best.weight > 0; }

/// The cells of a map that are in memory, in square tiles that are allocated when a scan reaches
/// them.
class CellTiles {
 public:
  static constexpr int tile_bits = 6;
  static constexpr std::int64_t tile_width = std::int64_t{1} << tile_bits;  ///< cells
  static_assert(tile_width == GroundMap::tile_width);
  static_assert(tile_width * tile_width == MapTile::cells);

  /// Row by row.
  using Tile = std::array<MapCell, MapTile::cells>;

  static TileIndex tile_of(CellIndex index) noexcept {
    return {.x = index.x >> tile_bits, .y = index.y >> tile_bits};
  }
  static std::size_t offset_in_tile(CellIndex index) noexcept {
    constexpr std::int64_t mask = tile_width - 1;
    return static_cast<std::size_t>((index.y & mask) * tile_width + (index.x & mask));
  }

  /// The cells of a tile, or null if the tile does not exist.
  [[nodiscard]] const Tile* tile(TileIndex tile) const noexcept {
    const auto found = tiles_.find(tile);
    return found == tiles_.end() ? nullptr : found->second.cells.get();
  }
  [[nodiscard]] Tile* tile(TileIndex index) noexcept {
    return const_cast<Tile*>(std::as_const(*this).tile(index));
  }

  /// The cell, or null if its tile does not exist.
  [[nodiscard]] const MapCell* find(CellIndex index) const noexcept {
    const Tile* const cells = tile(tile_of(index));
    return cells == nullptr ? nullptr : &(*cells)[offset_in_tile(index)];
  }

  /// Calls `work(index, tile)` for each tile, in any order.
  template <class Work>
  void for_each(const Work& work) const {
    for (const auto& [index, entry] : tiles_) work(index, *entry.cells);
  }

  /// The cells of a tile, which is allocated if it does not exist. `use` increases from scan to
  /// scan. May throw std::bad_alloc.
  Tile& allocate(TileIndex index, std::uint64_t use) {
    Entry& entry = tiles_[index];
    if (!entry.cells) entry.cells = std::make_unique<Tile>();
    entry.last_use = use;
    return *entry.cells;
  }

  void remove(TileIndex index) noexcept { tiles_.erase(index); }

  /// Removes the tiles whose centre is farther than `distance` cells from `centre`.
  void remove_beyond(CellIndex centre, double distance) noexcept;

  /// The tiles without the `kept` ones that were used last, sorted by use, y and x. May throw
  /// std::bad_alloc.
  [[nodiscard]] std::vector<TileIndex> least_used(std::size_t kept) const;

  [[nodiscard]] std::size_t size() const noexcept { return tiles_.size(); }
  [[nodiscard]] std::size_t cells_with_height() const noexcept;
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  struct Entry {
    std::unique_ptr<Tile> cells;
    std::uint64_t last_use = 0;
  };

  std::unordered_map<TileIndex, Entry, TileIndexHash> tiles_;
};

}  // namespace flagstone
