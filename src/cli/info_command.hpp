// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone info`: what a scan file holds.
void add_info_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
