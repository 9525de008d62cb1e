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
/// others has little weight. With fewer than 100 cells, or if the plane differs from the expected
/// one by more than 10 degrees or, at the sensor, by more than `max_correction` metres, the result
/// is the expected plane, not applied. Reuses `memory`. May throw std::bad_alloc.
Levelling fit_level(std::span<const HeightDifference> differences, const Levelling& expected,
                    double max_correction, std::vector<double>& memory);

}  // namespace flagstone
