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

/// The options that say on what methods are evaluated, how, and which files results are written to.
void add_evaluation_options(CLI::App& command, app::EvaluationOptions& options);

/// Writes `text` to a result file, if it is named, and prints that. Throws std::runtime_error.
void write_result(const std::string& file, const std::function<std::string()>& text);

}  // namespace flagstone::cli
