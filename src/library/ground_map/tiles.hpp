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
  std::uint16_t scans = 0;  ///< saturates

  /// Adds a measurement by its weight.
  void add(float measured, float its_weight) noexcept {
    weight += its_weight;
    height += its_weight / weight * (measured - height);
    if (scans < std::numeric_limits<std::uint16_t>::max()) ++scans;
  }
};

/// A cell: the height with the most evidence, and another one that contradicts it.
struct MapCell {
  HeightEvidence best, other;
  std::uint32_t last_scan = 0;  ///< number of the scan that measured the cell last
};

/// The cells of a map, in square tiles that are allocated when a scan reaches them.
class CellTiles {
 public:
  static constexpr int tile_bits = 6;
  static constexpr std::int64_t tile_width = std::int64_t{1} << tile_bits;  ///< cells

  /// The cell, or null if its tile does not exist.
  [[nodiscard]] const MapCell* find(CellIndex index) const noexcept {
    const auto tile = tiles_.find(tile_of(index));
    return tile == tiles_.end() ? nullptr : &(*tile->second)[offset_in_tile(index)];
  }
  [[nodiscard]] MapCell* find(CellIndex index) noexcept {
    return const_cast<MapCell*>(std::as_const(*this).find(index));
  }

  /// Allocates the tile of a cell. May throw std::bad_alloc.
  void allocate(CellIndex index) {
    std::unique_ptr<Tile>& tile = tiles_[tile_of(index)];
    if (!tile) tile = std::make_unique<Tile>();
  }

  /// Removes the tiles whose centre is farther than `distance` cells from `centre`.
  void remove_beyond(CellIndex centre, double distance) noexcept;

  [[nodiscard]] std::size_t cells_with_height() const noexcept;
  [[nodiscard]] std::size_t bytes() const noexcept;

 private:
  using Tile = std::array<MapCell, std::size_t{tile_width} * tile_width>;
  struct Hash {
    std::size_t operator()(CellIndex tile) const noexcept {
      const auto mixed = static_cast<std::uint64_t>(tile.x) * 0x9E3779B97F4A7C15U ^
                         static_cast<std::uint64_t>(tile.y) * 0xC2B2AE3D27D4EB4FU;
      return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
    }
  };

  static CellIndex tile_of(CellIndex index) noexcept {
    return {.x = index.x >> tile_bits, .y = index.y >> tile_bits};
  }
  static std::size_t offset_in_tile(CellIndex index) noexcept {
    constexpr std::int64_t mask = tile_width - 1;
    return static_cast<std::size_t>((index.y & mask) * tile_width + (index.x & mask));
  }

  std::unordered_map<CellIndex, std::unique_ptr<Tile>, Hash> tiles_;
};

}  // namespace flagstone
