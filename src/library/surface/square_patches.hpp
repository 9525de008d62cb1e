// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/surface_config.hpp"
#include "library/surface/square_cells.hpp"

namespace flagstone::surface {

/// A square of cells that one plane is fitted to.
struct SquarePatch {
  CellRange cells;
  float x, y;                 ///< centre, metres
  float size;                 ///< side, metres: 4 within 24 m of the sensor, else 8
  std::uint16_t size_class;   ///< 0: 4 m, 1: 8 m
  std::uint16_t row, column;  ///< counted in patches of its size from the edge, y and x ascending
};

/// The patches that planes are fitted to, nearest to the sensor first. Those that the sensor looks
/// down on, within twice its height and 6 m, are left out: only a car beside it can be there.
class SquarePatches {
 public:
  SquarePatches(const SurfaceConfig& config, const SquareCells& cells);

  [[nodiscard]] std::span<const SquarePatch> list() const noexcept { return list_; }

 private:
  std::vector<SquarePatch> list_;
};

}  // namespace flagstone::surface
