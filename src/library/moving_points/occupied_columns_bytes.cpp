// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "library/ground_map/presence_bits.hpp"
#include "library/ground_map/tile_indices.hpp"
#include "library/moving_points/occupied_columns.hpp"

namespace flagstone {

void OccupiedColumns::write(StateWriter& writer) const {
  const auto is_seen = [](const Counts& counts) { return (counts.empty | counts.occupied) != 0; };
  std::vector<TileIndex> indices;
  for (const auto& [index, tile] : tiles_) {
    if (std::ranges::any_of(*tile, is_seen)) indices.push_back(index);
  }
  sort_tiles(indices);
  writer.add(std::uint64_t{indices.size()});
  for (const TileIndex index : indices) {
    const Tile& tile = *tiles_.at(index);
    const PresenceBits<std::tuple_size_v<Tile>> seen(
        [&](std::size_t k) { return is_seen(tile[k]); });
    write_index(index, writer);
    seen.write(writer);
    for (const Counts& counts : tile) {
      if (!is_seen(counts)) continue;
      writer.add(counts.empty);
      writer.add(counts.occupied);
    }
  }
}

Status OccupiedColumns::read(StateReader& reader) {
  tiles_.clear();
  const auto count = reader.read<std::uint64_t>();
  if (reader.failed()) {
    return bad_state(reader.offset(), "the number of tiles is missing", "8 bytes");
  }
  TileIndexReader indices(static_cast<double>(tile_width) * width);
  for (std::uint64_t k = 0; k < count; ++k) {
    TileIndex index;
    if (Status status = indices.read(reader, index); !status.ok()) return status;
    const std::size_t offset = reader.offset();
    PresenceBits<std::tuple_size_v<Tile>> seen;
    if (!seen.read(reader) || !seen.any()) {
      return bad_state(offset, "the columns of a tile are missing",
                       "one bit per column, then the columns");
    }
    std::unique_ptr<Tile>& tile = tiles_[index];
    tile = std::make_unique<Tile>();
    for (std::size_t column = 0; column < tile->size(); ++column) {
      if (!seen[column]) continue;
      const std::size_t offset_of_column = reader.offset();
      Counts& counts = (*tile)[column];
      counts.empty = reader.read<std::uint16_t>();
      counts.occupied = reader.read<std::uint16_t>();
      if (reader.failed() || (counts.empty | counts.occupied) == 0) {
        return bad_state(offset_of_column, "a column without scans", "at least one scan");
      }
    }
  }
  return {};
}

}  // namespace flagstone
