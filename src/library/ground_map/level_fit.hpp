// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "flagstone/ground_map.hpp"

namespace flagstone {

/// The difference between the heights of a scan and of the map in a common cell.
struct HeightDifference {
  double dx = 0, dy = 0;  ///< from the sensor to the cell, metres
  double difference = 0;  ///< scan minus map, metres
};

/// Fits a plane to the differences, robustly: a cell that differs from the plane much more than the
/// others has little weight. Not applied with fewer than 100 cells, or if the plane is steeper than
/// 10 degrees or more than `max_correction` metres high at the sensor. Reuses `memory`. May throw
/// std::bad_alloc.
Levelling fit_level(std::span<const HeightDifference> differences, double max_correction,
                    std::vector<double>& memory);

}  // namespace flagstone
