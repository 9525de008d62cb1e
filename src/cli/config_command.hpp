// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone config`: prints every setting as commented TOML that --config reads back.
void add_config_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
