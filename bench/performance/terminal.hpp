// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace flagstone::performance {

/// Shows `text` on the last line of the terminal, in place of the previous text. Does nothing if
/// standard error is not a terminal.
inline void show_progress(const std::string& text) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
}

}  // namespace flagstone::performance
