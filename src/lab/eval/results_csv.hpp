// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lab/eval/results.hpp"

namespace flagstone::eval {

/// One row per method and scan: method, scan, the five shares (0 to 1), the counts they come from,
/// F1 of each range band and by area, milliseconds (empty for labels made elsewhere). Where heights
/// were scored, by band of range: median and 95th percentile of the absolute error, bias (metres,
/// over points of the ground; empty of none) and the share of points with a height. RFC 4180.
std::string to_csv(const Results& results);

/// A cell of CSV: in quotes where it needs them.
std::string csv_cell(const std::string& text);

}  // namespace flagstone::eval
