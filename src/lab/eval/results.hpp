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
#include "lab/eval/moving.hpp"
#include "lab/eval/scan_evaluator.hpp"
#include "lab/eval/statistics.hpp"

namespace flagstone::eval {

/// Results of one method on one scan.
struct ScanScore {
  std::string scan;
  Score score;
  std::optional<double> segment_ms;
  std::optional<HeightScore> heights{};
};

/// Height errors of one method over scans; see HeightErrors.
struct HeightFigures {
  std::size_t points = 0;             ///< number of points in all scans
  std::optional<double> share;        ///< fraction of them with a height; unset without points
  Spread median, percentile95, bias;  ///< over the scans with a height in the band, metres
};

struct HeightFiguresByRange {
  HeightFigures all;
  std::array<HeightFigures, height_bands.size()> by_range{};
};

/// Height errors over the point sets of HeightScore.
struct HeightResult {
  HeightFiguresByRange ground, everywhere;
  bool has_common = false;  ///< whether the sets of common points are set
  HeightFiguresByRange common_ground, common_everywhere;
};

/// Results of one method on each scan that could be read, and their averages.
struct MethodResult {
  std::string name;
  std::string title;
  std::vector<ScanScore> scans;

  Spread precision, recall, f1, accuracy, iou;  ///< macro-averages over scans
  Confusion pooled;                             ///< micro-average over the points of all scans
  std::array<Confusion, range_bands.size()> by_range{};
  Confusion by_area;
  std::optional<HeightResult>
      heights;               ///< set if the method provides heights and the true heights are known
  std::optional<double> hz;  ///< scans per second: 1 / mean time
  std::optional<double> hz_slowest_1_percent;  ///< 1 / mean of the slowest 1 % of the times
};

/// Score of the moving points of one source on one scan.
struct MovingScanScore {
  std::string scan;
  MovingScore score;
};

/// Moving points of one source, over scans.
struct MovingFigures {
  MovingCounts pooled;  ///< micro-average over the points of all scans
  Spread iou;           ///< macro-average over the scans that have moving points
};

/// Results of one source of moving points on each scan that could be read.
struct MovingResult {
  std::string name;
  std::vector<MovingScanScore> scans;
  MovingFigures all;  ///< points within the last range band
  std::array<MovingFigures, range_bands.size()> by_range{};
};

/// A scan that could not be read, or a method or source that failed on a scan.
struct Failure {
  std::string scan;
  std::string error;
};

/// Time spent, summed over scans and threads, milliseconds.
struct TimeSpent {
  double read = 0;
  double segment = 0;
  double score = 0;
};

/// Results of an evaluation.
struct Results {
  std::string protocol;
  std::vector<std::string> datasets;
  std::size_t scans = 0;  ///< scans that could be read and, with methods, have a scored point
  std::vector<std::string> unscored;  ///< scans without a scored point; excluded from all results
  /// Number of scans without ground in the ground truth; only accuracies include them.
  std::size_t without_ground = 0;
  unsigned threads = 1;
  std::vector<MethodResult> methods;
  std::vector<MovingResult> moving;
  std::vector<Failure> failures;
  TimeSpent time;
};

/// Combines outcomes into results: one outcome per scan, with the methods and the sources of moving
/// points in the given order; nullopt for scans that were not processed.
Results gather(std::span<const Method> methods, std::span<const LabelledScan> scans,
               std::span<const std::optional<ScanOutcome>> outcomes,
               std::span<const MovingSource> moving = {});

/// Whether at least one method has scored heights.
bool has_heights(const Results& results);

/// Whether heights of several methods are scored at common points.
bool has_common_heights(const Results& results);

/// Indices into `result.scans` of the `count` scans with the lowest F1, lowest first. Scans without
/// an F1 are omitted.
std::vector<std::size_t> worst_scans(const MethodResult& result, std::size_t count);

}  // namespace flagstone::eval
