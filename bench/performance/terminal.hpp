// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace flagstone::performance {

/// What is being measured, on the last line of a terminal; nothing where standard error is none.
inline void say_on_terminal(const std::string& text) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
}

}  // namespace flagstone::performance
