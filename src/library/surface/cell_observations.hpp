// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "flagstone/surface_config.hpp"
#include "library/surface/candidates.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/occupied_cells.hpp"
#include "library/surface/packed_points.hpp"

namespace flagstone::surface {

/// The surface within each cell of a grid as a plane over the x and y of packed points:
/// (slope_x * x + slope_y * y + offset) >> plane_shift, in the units of a packed z.
struct CellPlanes {
  std::int32_t* slopes;   ///< slope_x | slope_y << 16
  std::int32_t* offsets;  ///< with half a unit for rounding
};

/// Computes the planes of all cells of a grid of up to 256 x 256 cells. After the heights of the
/// grid 16 more must be readable, and after the planes 16 more are written. `packed_zero` is
/// the height of a packed z of 0, metres.
void find_planes(const Grid& grid, float packed_zero, const CellPlanes& planes) noexcept;

/// How cells are observed a second time in which the first observation finds no height.
enum class SecondLook : std::uint8_t {
  tilted,  ///< cells with an obstacle, with the slope of the lowest points of their halves: a bank
           ///< rises like an obstacle
  wide     ///< cells whose lowest points are above the gate, with a wider gate
};

/// Corrections of the surface from the points in the cells of a level. A positive correction raises
/// the surface.
struct Observations {
  const PackedPoint* points;  ///< of the scan, cell by cell; 16 more points must be readable
  CellPlanes planes;          ///< of the surface before the correction
  const std::int16_t* gates;  ///< by cell, in units of a packed z; see Refinement
  SecondLook second_look;
  int half_bit;           ///< a point is in the upper half of a cell if this bit of x or y is set
  std::int16_t widening;  ///< added to gates for SecondLook::wide
  float max_clutter_ratio;
  float lower_bound_weight;
  float* corrections;  ///< by cell, row by row, metres; only written for listed cells
  float* weights;      ///< by cell, 0 to 1, 0 without an observation; only written for listed cells
};

/// Observes cells of one size. Copies the cells that need a second look to `unclear` and returns
/// their number.
std::size_t observe(const Observations& observations, const OccupiedCells& cells, CellSize size,
                    OccupiedCell* unclear) noexcept;

/// Observes cells a second time, and writes one candidate for each. The tests for obstacles are
/// stricter than those of the first observation.
void observe_again(const Observations& observations, std::span<const OccupiedCell> cells,
                   Candidate* candidates) noexcept;

}  // namespace flagstone::surface
