// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// Adds `flagstone bench`; running it sets `exit_code`.
void add_bench_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
