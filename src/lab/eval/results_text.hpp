// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lab/eval/results.hpp"

namespace flagstone::eval {

/// How tables are set for where they go.
struct TextStyle {
  bool bold = false;  ///< the best of a column in bold (terminals) instead of with an asterisk
};

/// Table I of the paper: a row per method, precision and recall with their standard deviations, F1
/// with its 95 % interval, then accuracy, IoU, F1 by area and scans a second.
std::string accuracy_table(const Results& results, const TextStyle& style);

/// F1 of every method in each band of range, pooled over points.
std::string range_table(const Results& results, const TextStyle& style);

/// Errors of the heights of methods that give some, in each band of range, means over scans,
/// centimetres: median and 95th percentile of the absolute error, bias; and the share of points
/// with a height, per cent. `points` picks which.
std::string height_table(const Results& results, HeightFiguresByRange HeightResult::* points,
                         const TextStyle& style);

/// The `count` scans with the lowest F1 of every method.
std::string worst_table(const Results& results, std::size_t count);

/// Table II of the paper: scans a second on one core, mean and slowest 1 %, beside the paper's own.
std::string speed_table(const Results& results);

/// Where the time went: reading, segmenting, scoring.
std::string time_shares(const Results& results);

}  // namespace flagstone::eval
