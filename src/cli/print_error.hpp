// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace flagstone::cli {

/// Prints "flagstone: MESSAGE" on standard error, on one line whatever file names and settings the
/// message quotes: control characters in it are spelled as in "\x0a".
void print_error(std::string_view message);

}  // namespace flagstone::cli
