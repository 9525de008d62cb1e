// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/render/ground_map_picture.hpp"
#include "flagstone/ground_map.hpp"
#include "flagstone/status.hpp"

namespace flagstone::app {

/// The files of a ground map: one array per tile, and map.json with the geometry of all tiles.
struct GroundMapFiles {
  std::filesystem::path directory;  ///< created if it does not exist

  /// The file of a tile.
  [[nodiscard]] std::filesystem::path tile(TileIndex index) const;
  [[nodiscard]] std::filesystem::path geometry() const { return directory / "map.json"; }

  /// Writes every tile with a height, then map.json, which lists them. Each file is written
  /// atomically. The map.json of an earlier map is removed first, so that an interrupted call does
  /// not leave one that describes other tiles. Tiles of an earlier map that this map does not have
  /// stay, but are not listed. Errors: unwritable, out_of_memory.
  [[nodiscard]] Status write(const GroundMap& map) const;
};

/// The heights of a map for an image.
struct HeightGrid {
  std::vector<float> heights;  ///< as in render::GroundGrid
  std::size_t columns = 0;
  double cell = 1;  ///< metres
  double min_x = 0, min_y = 0;

  [[nodiscard]] render::GroundGrid view() const noexcept {
    return {.heights = heights, .columns = columns, .cell = cell, .min_x = min_x, .min_y = min_y};
  }
};

/// The heights of all tiles, in at most `max_cells` cells along each side: if the map has more,
/// each height is the mean of the known heights of 2 x 2, 4 x 4, ... 64 x 64 cells. No cells if the
/// map is empty. Throws std::bad_alloc.
HeightGrid height_grid(const GroundMap& map, std::size_t max_cells = 2400);

}  // namespace flagstone::app
