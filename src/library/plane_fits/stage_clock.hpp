// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>

#include "flagstone/stage_times.hpp"

namespace flagstone::plane_fits {

/// Measures the time per stage. Does nothing if timing is off.
class StageClock {
 public:
  /// Starts the clock. If `times` is null, timing is off.
  explicit StageClock(StageTimes* times) noexcept : times_(times) {
    if (times_ != nullptr) last_ = Clock::now();
  }

  /// Adds the time since the previous call to `stage`.
  void end(Stage stage) noexcept {
    if (times_ == nullptr) return;
    const Clock::time_point now = Clock::now();
    (*times_)[static_cast<std::size_t>(stage)] +=
        std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StageTimes* times_;
  Clock::time_point last_;
};

}  // namespace flagstone::plane_fits
