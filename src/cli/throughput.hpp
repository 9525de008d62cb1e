// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "cli/scan_report.hpp"

namespace flagstone::cli {

/// How long a crew was at work, and how many they were.
struct CrewTime {
  double seconds = 0;
  std::size_t workers = 1;
};

/// A line for people: scans and megabytes (10^6 bytes) a second, what the workers spent their time
/// on, and which of files and segmenting takes more of it. "Other" is all that is neither:
/// pictures, scores, printing, waiting for one another. Failed scans do not count. Empty where none
/// is left.
std::string throughput_text(std::span<const ScanReport> reports, const CrewTime& time);

}  // namespace flagstone::cli
