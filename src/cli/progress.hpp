// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace flagstone::cli {

/// A bar with the time left on the last line of the terminal; nothing where standard error is none.
class Progress {
 public:
  explicit Progress(std::size_t total);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Draws the bar at `done` of the total.
  void show(std::size_t done);

  /// Takes the bar away, to print something else.
  void clear();

 private:
  std::size_t total_;
  bool on_terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The bar's text: "[######          ]  40 of 100 scans, 12 s left".
std::string progress_text(std::size_t done, std::size_t total, std::chrono::duration<double> spent);

}  // namespace flagstone::cli
