// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lab/eval/results.hpp"
#include "lab/eval/statistics.hpp"

namespace flagstone::eval {

/// An evaluation as JSON: `protocol`, `scans` (how many), `machine`, `date`, `failed` and per
/// method `name`, `title`, `scans`, `precision`, `recall`, `f1`, `accuracy`, `iou` (each `mean`,
/// `std`, `ci95`), `pooled`, `by_range`, `by_area`, `hz`, `hz_slowest_1_percent`, `worst` and
/// `per_scan`. Shares are 0 to 1, times milliseconds; null is a number that there is none of.
nlohmann::ordered_json to_json(const Results& results);

/// `mean`, `std` and `ci95` of a figure.
nlohmann::ordered_json to_json(const Spread& spread);

/// What every results file begins with: flagstone's version, the date (UTC) and the machine.
nlohmann::ordered_json results_heading();

}  // namespace flagstone::eval
