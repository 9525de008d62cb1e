// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone segment`: scans in, labels and pictures out. `exit_code` is set when it has run.
void add_segment_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
