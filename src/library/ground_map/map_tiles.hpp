// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "flagstone/ground_map.hpp"
#include "library/ground_map/last_levelling.hpp"
#include "library/ground_map/scan_heights.hpp"
#include "library/ground_map/tile_archive.hpp"
#include "library/ground_map/tiles.hpp"

namespace flagstone {

/// The state of a GroundMap.
class GroundMap::Tiles {
 public:
  GroundMapConfig config;
  CellTiles cells;
  std::unique_ptr<TileArchive> archive;  // of a map with a TileStore, otherwise null
  double base = 0;  // z of the sensor in the first scan; stored heights are relative to it
  std::size_t scans = 0;
  LastLevelling last;

  /// Reads those tiles of the heights that are in the store.
  Status recall(std::span<const MeasuredHeight> heights);

  /// Stores the tiles beyond the memory limit.
  Status unload();

  /// A cell in memory or in the store; without heights if the map does not have it.
  [[nodiscard]] MapCell cell(CellIndex index) const noexcept {
    if (const MapCell* const found = cells.find(index); found != nullptr) return *found;
    return archive ? archive->cell(index) : MapCell();
  }
};

}  // namespace flagstone
