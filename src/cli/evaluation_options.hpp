// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "app/evaluate.hpp"

namespace CLI {
class App;
}

namespace flagstone::cli {

/// Adds the datasets and the options of `eval` and `sweep`: protocol, scans to use, result files.
void add_evaluation_options(CLI::App& command, app::EvaluationOptions& options);

/// Writes `text` to `file` and prints its name; does nothing if `file` is empty. Throws
/// std::runtime_error if it cannot be written.
void write_result(const std::string& file, const std::function<std::string()>& text);

}  // namespace flagstone::cli
