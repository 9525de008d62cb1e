// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/tile_index_hash.hpp"
#include "library/ground_map/tiles.hpp"

namespace flagstone {

/// The tiles of a map that are in a TileStore instead of in memory. read(), cell() and bytes_of()
/// can be called from several threads at once.
class TileArchive {
 public:
  explicit TileArchive(std::shared_ptr<TileStore> store) noexcept : store_(std::move(store)) {}

  [[nodiscard]] bool contains(TileIndex index) const noexcept { return heights_.contains(index); }

  /// Calls `work(index)` for each tile, in any order.
  template <class Work>
  void for_each(const Work& work) const {
    for (const auto& [index, heights] : heights_) work(index);
  }

  /// Stores a tile. May throw std::bad_alloc.
  Status put(TileIndex index, const CellTiles::Tile& tile);

  /// Reads a tile, which must have zeros. The errors of the store, bad_file if the bytes are not
  /// a tile, out_of_memory. Never throws.
  Status read(TileIndex index, CellTiles::Tile& tile) const;

  /// Forgets a tile, which is in memory again.
  void forget(TileIndex index) noexcept { heights_.erase(index); }
  void clear() noexcept { heights_.clear(); }

  /// The bytes of a tile, as written by write_cells(). Errors as read().
  Status bytes_of(TileIndex index, std::vector<std::byte>& bytes) const;

  /// A cell; empty if its tile is not here or cannot be read.
  [[nodiscard]] MapCell cell(CellIndex index) const noexcept;

  /// Number of cells with a height.
  [[nodiscard]] std::size_t cells_with_height() const noexcept;

 private:
  struct Recent {
    TileIndex index;
    std::unique_ptr<CellTiles::Tile> tile;  // null: none
  };

  std::shared_ptr<TileStore> store_;
  std::unordered_map<TileIndex, std::size_t, TileIndexHash> heights_;  // number per tile
  mutable std::mutex mutex_;                                           // of the rest
  mutable std::array<Recent, 4> recent_;  // the last tiles that were read
  mutable std::size_t oldest_ = 0;
};

}  // namespace flagstone
