// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/tile_archive.hpp"

#include <algorithm>
#include <new>

#include "library/ground_map/tile_bytes.hpp"

namespace flagstone {

Status TileArchive::put(TileIndex index, const CellTiles::Tile& tile) {
  std::vector<std::byte> bytes;
  StateWriter writer(bytes);
  write_cells(tile, writer);
  heights_.reserve(heights_.size() + 1);
  const std::scoped_lock lock(mutex_);
  for (Recent& recent : recent_) {
    if (recent.index == index) recent.tile.reset();
  }
  if (Status status = store_->put(index, bytes); !status.ok()) return status;
  heights_[index] = static_cast<std::size_t>(std::ranges::count_if(tile, has_height));
  return {};
}

Status TileArchive::bytes_of(TileIndex index, std::vector<std::byte>& bytes) const {
  const std::scoped_lock lock(mutex_);
  try {
    return store_->get(index, bytes);
  } catch (const std::bad_alloc&) {
    return Status(StatusCode::out_of_memory);
  }
}

Status TileArchive::read(TileIndex index, CellTiles::Tile& tile) const {
  std::vector<std::byte> bytes;
  if (Status status = bytes_of(index, bytes); !status.ok()) return status;
  StateReader reader(bytes);
  if (Status status = read_cells(reader, tile); !status.ok()) return status;
  if (reader.left() == 0) return {};
  return bad_state(reader.offset(), "bytes after the last cell", "the tile as it was stored");
}

MapCell TileArchive::cell(CellIndex index) const noexcept {
  const TileIndex at = CellTiles::tile_of(index);
  if (!contains(at)) return {};
  const auto find = [&]() -> const Recent* {
    const auto found = std::ranges::find_if(recent_, [&](const Recent& recent) {
      return recent.tile != nullptr && recent.index == at;
    });
    return found == recent_.end() ? nullptr : &*found;
  };
  const auto cell_of = [&](const Recent& recent) {
    return (*recent.tile)[CellTiles::offset_in_tile(index)];
  };
  {
    const std::scoped_lock lock(mutex_);
    if (const Recent* const recent = find(); recent != nullptr) return cell_of(*recent);
  }
  try {
    auto tile = std::make_unique<CellTiles::Tile>();
    if (!read(at, *tile).ok()) return {};
    const std::scoped_lock lock(mutex_);
    Recent& replaced = recent_[oldest_];
    oldest_ = (oldest_ + 1) % recent_.size();
    replaced = {.index = at, .tile = std::move(tile)};
    return cell_of(replaced);
  } catch (const std::bad_alloc&) {
    return {};
  }
}

std::size_t TileArchive::cells_with_height() const noexcept {
  std::size_t sum = 0;
  for (const auto& [index, heights] : heights_) sum += heights;
  return sum;
}

}  // namespace flagstone
