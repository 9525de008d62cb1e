// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone simulate`: writes sequences of simulated scans with exact truth.
void add_simulate_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
