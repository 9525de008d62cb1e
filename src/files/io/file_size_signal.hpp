// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#ifndef _WIN32
#include <pthread.h>

#include <csignal>
#endif

namespace flagstone::io {

/// RAII guard for the current thread: a write beyond the file size limit (ulimit -f) fails as on a
/// full disk. Without it, SIGXFSZ would end the process; the guard blocks and then discards it.
/// Windows has no such limit.
#ifdef _WIN32
struct [[maybe_unused]] FileSizeSignalBlocked {};
#else
class FileSizeSignalBlocked {
 public:
  FileSizeSignalBlocked() {  // without ::, because macOS has macros with the names of these
                             // functions
    sigemptyset(&signal_);
    sigaddset(&signal_, SIGXFSZ);
    ::pthread_sigmask(SIG_BLOCK, &signal_, &before_);
  }
  FileSizeSignalBlocked(const FileSizeSignalBlocked&) = delete;
  FileSizeSignalBlocked& operator=(const FileSizeSignalBlocked&) = delete;
  FileSizeSignalBlocked(FileSizeSignalBlocked&&) = delete;
  FileSizeSignalBlocked& operator=(FileSizeSignalBlocked&&) = delete;
  ~FileSizeSignalBlocked() {
    if (sigismember(&before_, SIGXFSZ) == 0) discard();
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  void discard() const {
#ifdef __APPLE__  // has no sigtimedwait
    sigset_t pending{};
    int number = 0;
    ::sigpending(&pending);
    if (sigismember(&pending, SIGXFSZ) == 1) ::sigwait(&signal_, &number);
#else
    const timespec now{};
    ::sigtimedwait(&signal_, nullptr, &now);
#endif
  }

  sigset_t signal_{};
  sigset_t before_{};
};
#endif

}  // namespace flagstone::io
