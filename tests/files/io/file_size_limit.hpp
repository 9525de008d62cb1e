// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#ifndef _WIN32
#include <sys/resource.h>
#endif

namespace flagstone::io {

/// RAII guard that limits the size of every file to `bytes`, to simulate a full disk. A write
/// beyond the limit fails, and raises SIGXFSZ unless it is blocked. Child processes inherit the
/// limit. Has no effect on Windows.
#ifdef _WIN32
struct [[maybe_unused]] FileSizeLimit {
  explicit FileSizeLimit(int /*bytes*/) {}
};
#else
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  FileSizeLimit(FileSizeLimit&&) = delete;
  FileSizeLimit& operator=(FileSizeLimit&&) = delete;
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};
#endif

}  // namespace flagstone::io
