// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lab/eval/dataset.hpp"
#include "lab/eval/method.hpp"
#include "lab/eval/scan_evaluator.hpp"
#include "lab/eval/statistics.hpp"

namespace flagstone::eval {

/// One method's scan.
struct ScanScore {
  std::string scan;
  Score score;
  std::optional<double> segment_ms;
  std::optional<HeightScore> heights{};
};

/// Errors of one method's heights over scans; see HeightErrors.
struct HeightFigures {
  std::size_t points = 0;             ///< of all scans
  std::optional<double> share;        ///< of them, those with a height; none of no points
  Spread median, percentile95, bias;  ///< over the scans that have a height there, metres
};

struct HeightFiguresByRange {
  HeightFigures all;
  std::array<HeightFigures, height_bands.size()> by_range{};
};

/// As HeightScore.
struct HeightResult {
  HeightFiguresByRange ground, everywhere;
};

/// One method over all scans that could be read, and what that comes to.
struct MethodResult {
  std::string name;
  std::string title;
  std::vector<ScanScore> scans;

  Spread precision, recall, f1, accuracy, iou;  ///< over scans
  Confusion pooled;                             ///< over points
  std::array<Confusion, range_bands.size()> by_range{};
  Confusion by_area;
  std::optional<HeightResult> heights;  ///< of methods that give heights where the truth is known
  std::optional<double> hz;             ///< scans a second: 1 / mean time
  std::optional<double> hz_slowest_1_percent;  ///< 1 / mean of the slowest 1 % of times
};

/// A scan, or a method on a scan, that came to nothing.
struct Failure {
  std::string scan;
  std::string error;
};

/// Where the time went, summed over scans and threads, milliseconds.
struct TimeSpent {
  double read = 0;
  double segment = 0;
  double score = 0;
};

/// The outcome of an evaluation.
struct Results {
  std::string protocol;
  std::vector<std::string> datasets;
  std::size_t scans = 0;              ///< that could be read and have a point to score
  std::vector<std::string> unscored;  ///< scans without one, which no figure counts
  /// Of `scans`, those without ground in the ground truth: they count in accuracies alone.
  std::size_t without_ground = 0;
  unsigned threads = 1;
  std::vector<MethodResult> methods;
  std::vector<Failure> failures;
  TimeSpent time;
};

/// Gathers outcomes, one per scan and each with the methods in their order; none for scans that
/// were not reached.
Results gather(std::span<const Method> methods, std::span<const LabelledScan> scans,
               std::span<const std::optional<ScanOutcome>> outcomes);

/// Does a method have heights that could be scored?
bool has_heights(const Results& results);

/// Indices into `result.scans` of the `count` scans with the lowest F1, lowest first; scans without
/// an F1 are left out.
std::vector<std::size_t> worst_scans(const MethodResult& result, std::size_t count);

}  // namespace flagstone::eval
