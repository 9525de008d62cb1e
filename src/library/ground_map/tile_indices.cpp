// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/tile_indices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "library/ground_map/poses.hpp"

namespace flagstone {
namespace {

bool is_before(TileIndex a, TileIndex b) noexcept { return a.y != b.y ? a.y < b.y : a.x < b.x; }

}  // namespace

void sort_tiles(std::vector<TileIndex>& tiles) { std::ranges::sort(tiles, is_before); }

void write_index(TileIndex index, StateWriter& writer) {
  writer.add(index.x);
  writer.add(index.y);
}

Status TileIndexReader::read(StateReader& reader, TileIndex& index) {
  const std::size_t offset = reader.offset();
  index.x = reader.read<std::int64_t>();
  index.y = reader.read<std::int64_t>();
  const auto is_far = [&](std::int64_t place) {
    return !(std::abs(static_cast<double>(place)) * tile_size_ <= 2 * max_world_position);
  };
  if (reader.failed() || is_far(index.x) || is_far(index.y) ||
      (last_ && !is_before(*last_, index))) {
    return bad_state(offset, "not the index of the next tile",
                     "as many tiles as in the header, sorted by y, then x");
  }
  last_ = index;
  return {};
}

}  // namespace flagstone
