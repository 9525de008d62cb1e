// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace flagstone::report {

/// What the plots of an eval report draw, a small part of its results: all scans' names once, and
/// per method title, precision, recall, f1, ci95, hz, hz_slowest, by_range (F1 per band) and scans
/// (F1 per scan; null where the method has none). Shares as in the results, 0 to 1.
nlohmann::ordered_json eval_plot_data(const nlohmann::ordered_json& results);

/// A band of range as text: "0–10 m".
std::string band_text(const nlohmann::ordered_json& band);

/// The range bands of the first method that has some, as text: "0–10 m".
std::vector<std::string> range_bands(const nlohmann::ordered_json& results);

}  // namespace flagstone::report
