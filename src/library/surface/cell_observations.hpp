// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/surface_config.hpp"
#include "library/plane_fits/bin_groups.hpp"
#include "library/surface/grid.hpp"

namespace flagstone::surface {

/// A cell of a grid and its points.
struct OccupiedCell {
  std::uint32_t first;  ///< index of its first point
  std::uint32_t count;
  std::uint32_t row, column;
};

/// Corrections of the surface from the points in the cells of a level. A positive correction raises
/// the surface.
struct Observations {
  const plane_fits::MovedPoint*
      points;           ///< of the scan, cell by cell; 16 more points must be readable
  const Grid* surface;  ///< before the correction
  float gate;           ///< of the level, metres; see Refinement
  float gate_per_metre;
  float max_clutter_ratio;
  float lower_bound_weight;
  float* corrections;  ///< by cell, row by row, metres; only written for observed cells
  float* weights;      ///< by cell, 0 to 1; only written for observed cells
};

/// Maximum number of points of a small cell.
inline constexpr std::uint32_t small_cell = 16;
enum class CellSize : std::uint8_t { small, any };

/// Observes cells. With `CellSize::small`, which takes half the time, all cells must be small. At
/// most 32 points per cell are used, selected evenly from all points of the cell.
void observe(const Observations& observations, std::span<const OccupiedCell> cells,
             CellSize size) noexcept;

}  // namespace flagstone::surface
