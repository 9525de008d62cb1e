// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace flagstone::cli {

/// `flagstone doctor`: looks at scans and says what to set. Sets `exit_code` to 0 where all
/// is fine, 1 where something is to fix or a scan could not be read.
void add_doctor_command(CLI::App& app, int& exit_code);

}  // namespace flagstone::cli
