// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <sys/stat.h>

#include <filesystem>

namespace flagstone::io {

/// Creates a pipe in a directory. Returns false if that fails, as on Windows.
inline bool make_pipe([[maybe_unused]] const std::filesystem::path& path) {
#ifdef _WIN32
  return false;
#else
  return ::mkfifo(path.c_str(), 0600) == 0;
#endif
}

}  // namespace flagstone::io
