// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include "lab/bench/results.hpp"

namespace flagstone::bench {

/// Results as one object. `method` is the name of the one timed. Times are milliseconds a scan;
/// ratios are medians over scans and rounds: `ratio_to_floor` and `ratio_to_scalar` of segment's
/// time to the bare pass's and the scalar build's, `ratio` of a stage's time to the bare pass's and
/// of a peer's to segment's. What was not measured is null, and a peer that is not there has
/// `left_out`, the reason.
[[nodiscard]] nlohmann::ordered_json to_json(const Results& results);

}  // namespace flagstone::bench
