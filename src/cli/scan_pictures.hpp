// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "cli/evaluation.hpp"
#include "lab/report/eval_report.hpp"

namespace flagstone::cli {

/// Draws the `count` scans with the lowest F1, averaged over the methods, each with all methods
/// side by side, as SCAN.png in `folder`. Returns the pictures for a report.
/// Throws std::runtime_error with one line.
std::vector<report::ReportPicture> draw_worst_scans(const Evaluation& evaluation,
                                                    const eval::Results& results, std::size_t count,
                                                    const std::filesystem::path& folder);

}  // namespace flagstone::cli
