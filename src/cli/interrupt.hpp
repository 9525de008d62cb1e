// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

namespace flagstone::cli {

/// From now on the first SIGINT or SIGTERM asks to stop after the scans in hand; the second ends
/// the program at once.
void catch_interrupts();

/// Has somebody asked to stop?
bool interrupted() noexcept;

}  // namespace flagstone::cli
