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
  std::uint32_t first;  ///< of its points, an index
  std::uint32_t count;
  std::uint32_t row, column;
};

/// What the points of a level's cells say about the surface there: how far it lies above where it
/// was before.
struct Observations {
  const plane_fits::MovedPoint* points;  ///< of the scan, cell by cell; 16 more may be read
  const Grid* surface;                   ///< as it was before
  float gate;                            ///< metres, see Refinement
  float gate_per_metre;
  float max_clutter_ratio;
  float lower_bound_weight;
  float* corrections;  ///< by cell, row by row: metres; only written where the weight is
  float* weights;      ///< by cell: 0 to 1; only written where something is known
};

/// A cell of up to as many points is small.
inline constexpr std::uint32_t small_cell = 16;
enum class CellSize : std::uint8_t { small, any };

/// Observes cells, none larger than `size` says: small ones take half the time. Of up to 32 points
/// of a cell all are looked at, of more 32, evenly from all of them.
void observe(const Observations& observations, std::span<const OccupiedCell> cells,
             CellSize size) noexcept;

}  // namespace flagstone::surface
