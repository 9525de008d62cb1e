// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lab/eval/results.hpp"
#include "lab/eval/statistics.hpp"

namespace flagstone::eval {
/// An evaluation as JSON: `protocol`, `scans` (number of scans), `machine`, `date`, `failed` and,
/// per method, `name`, `title`, `scans`, `precision`, `recall`, `f1`, `accuracy`, `iou` (each with
/// `mean`, `std`, `ci95`), `pooled` (micro-average), `by_range`, `by_area` (per BEV cell), `hz`,
/// `hz_slowest_1_percent`, `worst` and `per_scan`. Ratios are 0 to 1, times are in milliseconds,
/// and null is an undefined number. `without_ground` is the number of scans without ground in the
/// ground truth; only means of the accuracy include them. `moving`, if moving points were
/// evaluated: per source, `name`, `scans`, metrics over the points of all scans, `mean_iou` (over
/// scans), `by_range` and `per_scan`.
nlohmann::ordered_json to_json(const Results& results);

/// `mean`, `std` and `ci95` of a metric, and the number of `scans`.
nlohmann::ordered_json to_json(const Spread& spread);

/// Heading of every results file: flagstone's version, the date (UTC) and the machine.
nlohmann::ordered_json results_heading();

/// CSV (RFC 4180) with one row per method and scan: method, scan, the five ratios (0 to 1; empty if
/// undefined), their counts, F1 of each range band and per BEV cell, milliseconds (empty for labels
/// of another program). If heights were scored, then for each range band: median and 95th
/// percentile of the absolute error and bias over ground points, metres (empty without points), and
/// the fraction of points with a height. The same columns with `height_common` follow if several
/// methods have heights: ground points for which every method provides a height.
std::string to_csv(const Results& results);

/// A CSV cell, quoted if necessary.
std::string csv_cell(const std::string& text);

/// The machine of a measurement: the name of the CPU as reported by the system, and the number of
/// usable cores.
std::string machine_name();

/// Today's date, UTC, in the form 2026-11-21.
std::string today();

}  // namespace flagstone::eval
