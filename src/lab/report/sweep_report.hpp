// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace flagstone::report {

/// Converts the results of `flagstone sweep`, in the format of its --json, to one self-contained
/// HTML file. It shows F1, precision and recall as lines over the first key, with one line per
/// value of the second key (as Fig. 5 of the paper). If both keys are numbers and the second has
/// more than six values, it shows shaded tables instead. Throws nlohmann::json::exception or
/// std::invalid_argument if `results` does not have this format.
std::string sweep_report(const nlohmann::ordered_json& results);

}  // namespace flagstone::report
