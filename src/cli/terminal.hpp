// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "app/run.hpp"

namespace flagstone::cli {

/// Prints "flagstone: MESSAGE" on standard error, on one line whatever file names and settings the
/// message quotes: control characters in it are spelled as in "\x0a".
void print_error(std::string_view message);

/// From now on the first SIGINT or SIGTERM asks to stop after the scans in hand; the second ends
/// the program at once.
void catch_interrupts();

/// Has somebody asked to stop?
bool interrupted() noexcept;

/// Progress on the last line of the terminal, as wide as the terminal at most; nothing if standard
/// error is not a terminal, or for a single job.
class ProgressBar {
 public:
  ProgressBar() = default;
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const app::Progress& progress);

  /// Takes the bar away, to print something else.
  void clear();

  /// Draws progress with this bar, prints messages as errors, stops when interrupted. Use it while
  /// the bar lives.
  [[nodiscard]] app::RunCallbacks callbacks();

 private:
  bool shown_ = false;
};

}  // namespace flagstone::cli
