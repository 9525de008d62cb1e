// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "app/evaluate.hpp"
#include "lab/report/eval_report.hpp"

namespace flagstone::app {

/// Draws the `count` scans with the lowest mean F1 over the methods, all methods side by side, as
/// SCAN.png in `folder`. Draws fewer if stopped. Calls `drawn` with each file and returns the
/// images for a report. Throws std::runtime_error with one line.
std::vector<report::ReportPicture> draw_worst_scans(
    const Evaluation& evaluation, const eval::Results& results, std::size_t count,
    const std::filesystem::path& folder, const RunCallbacks& callbacks,
    const std::function<void(const std::filesystem::path&)>& drawn);

}  // namespace flagstone::app
