// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "library/ground_map/state_bytes.hpp"
#include "library/ground_map/tiles.hpp"

namespace flagstone {

/// Appends the cells of a tile: one bit per cell that was measured, then these cells. May throw
/// std::bad_alloc.
void write_cells(const CellTiles::Tile& tile, StateWriter& writer);

/// Reads the cells of a tile with zeros. bad_file if they end early, or a number is not possible.
Status read_cells(StateReader& reader, CellTiles::Tile& tile);

}  // namespace flagstone
