// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#ifndef _WIN32
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace flagstone::tests {

/// Runs `work()` in a child process and returns its exit code, which is the result of `work()`; 124
/// if the child takes longer than 20 seconds, and on Windows, which has no fork().
template <class Work>
int exit_code_of_child([[maybe_unused]] const Work& work) {
#ifdef _WIN32
  return 124;
#else
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);
    _exit(work());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 124;
#endif
}

}  // namespace flagstone::tests
