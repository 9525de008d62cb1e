// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/state_bytes.hpp"

namespace flagstone {

/// Sorts tiles in the order in which a state contains them: by y, then by x.
void sort_tiles(std::vector<TileIndex>& tiles);

/// Appends the index of a tile. May throw std::bad_alloc.
void write_index(TileIndex index, StateWriter& writer);

/// Reads the indices of the tiles of a state, one after another.
class TileIndexReader {
 public:
  /// `tile_size`: width of a tile, metres.
  explicit TileIndexReader(double tile_size) noexcept : tile_size_(tile_size) {}

  /// bad_file if the bytes end, the tile is farther away than a position can be, or it does not
  /// follow the one before.
  Status read(StateReader& reader, TileIndex& index);

 private:
  double tile_size_;
  std::optional<TileIndex> last_;
};

}  // namespace flagstone
