// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "app/run.hpp"

namespace flagstone::cli {

/// Prints "flagstone: MESSAGE" on standard error, always on one line: control characters, which
/// file names and settings may contain, are escaped as in "\x0a".
void print_error(std::string_view message);

/// Installs signal handlers: after the first SIGINT or SIGTERM, the run stops when the scans in
/// progress are done; the second one ends the program immediately.
void catch_interrupts();

/// True after the first SIGINT or SIGTERM.
bool interrupted() noexcept;

/// Shows progress on the last line of the terminal, at most as wide as the terminal. Shows nothing
/// if standard error is not a terminal or if there is only one job.
class ProgressBar {
 public:
  ProgressBar() = default;
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const app::Progress& progress);

  /// Removes the bar, so that something else can be printed.
  void clear();

  /// Callbacks that show progress with this bar, print messages as errors and stop on a signal.
  /// They must not outlive the bar.
  [[nodiscard]] app::RunCallbacks callbacks();

 private:
  bool shown_ = false;
};

}  // namespace flagstone::cli
