// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace flagstone::report {

/// The results of `flagstone sweep`, as its --json writes them, as one HTML file that loads nothing
/// from anywhere: F1, precision and recall as lines over the first key, a line per value of the
/// second (the paper's Fig. 5), or as tables in shades where both keys are numbers and the second
/// has more than six values. Throws nlohmann::json::exception or std::invalid_argument where
/// `results` is not of that form.
std::string sweep_report(const nlohmann::ordered_json& results);

}  // namespace flagstone::report
