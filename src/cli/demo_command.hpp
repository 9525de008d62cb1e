// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone demo`: simulates a street, segments it and shows what came out.
void add_demo_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
