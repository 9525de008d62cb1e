// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "lab/eval/results.hpp"
#include "lab/eval/statistics.hpp"

namespace flagstone::eval {
/// An evaluation as JSON: `protocol`, `scans` (how many), `machine`, `date`, `failed` and per
/// method `name`, `title`, `scans`, `precision`, `recall`, `f1`, `accuracy`, `iou` (each `mean`,
/// `std`, `ci95`), `pooled`, `by_range`, `by_area`, `hz`, `hz_slowest_1_percent`, `worst` and
/// `per_scan`. Ratios are 0 to 1, times milliseconds; null is an undefined
/// number. `without_ground` counts the scans without ground in the ground truth: they have an
/// accuracy alone, and no other mean counts them.
nlohmann::ordered_json to_json(const Results& results);

/// `mean`, `std` and `ci95` of a figure, and over how many `scans`.
nlohmann::ordered_json to_json(const Spread& spread);

/// What every results file begins with: flagstone's version, the date (UTC) and the machine.
nlohmann::ordered_json results_heading();

/// One row per method and scan: method, scan, the five ratios (0 to 1; empty where undefined), the
/// counts they come from,
/// F1 of each range band and by area, milliseconds (empty for labels made elsewhere). Where heights
/// were scored, by band of range: median and 95th percentile of the absolute error, bias (metres,
/// over points of the ground; empty of none) and the share of points with a height. RFC 4180.
std::string to_csv(const Results& results);

/// A cell of CSV: in quotes where it needs them.
std::string csv_cell(const std::string& text);

/// What figures were measured on: the processor's name as the system gives it, and how many cores
/// there are to use.
std::string machine_name();

/// The date, UTC, as 2026-11-21.
std::string today();

}  // namespace flagstone::eval
