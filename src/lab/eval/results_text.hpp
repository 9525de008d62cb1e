// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lab/eval/results.hpp"

namespace flagstone::eval {

/// Format of tables.
struct TextStyle {
  bool bold = false;  ///< the best of a column in bold (terminals) instead of with an asterisk
};

/// Table I of the paper, one row per method: precision and recall with their standard deviations,
/// F1 with its 95 % confidence interval, accuracy, IoU, F1 per BEV cell and scans per second.
std::string accuracy_table(const Results& results, const TextStyle& style);

/// F1 of every method in each range band, as micro-average over points.
std::string range_table(const Results& results, const TextStyle& style);

/// Height errors in each range band, averaged over scans, in centimetres: median and 95th
/// percentile of the absolute error, and bias. Then coverage: the percentage of points with a
/// height. `points` selects the set of points. Methods without heights are omitted.
std::string height_table(const Results& results, HeightFiguresByRange HeightResult::* points,
                         const TextStyle& style);

/// Moving points of each source in each range band and in all bands together: metrics over the
/// points of all scans in percent, number of moving points, mean and 95 % confidence interval of
/// the IoU over scans.
std::string moving_table(const Results& results);

/// The `count` scans with the lowest F1 of every method.
std::string worst_table(const Results& results, std::size_t count);

/// Table II of the paper: scans per second on one core, mean and slowest 1 %, next to the values of
/// the paper.
std::string speed_table(const Results& results);

/// Percentages of time spent on reading, segmenting and scoring.
std::string time_shares(const Results& results);

}  // namespace flagstone::eval
