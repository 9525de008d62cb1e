// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>

#include "flagstone/stage_times.hpp"

namespace flagstone::plane_fits {

/// Books the time that passes on stages; does nothing where nobody asked for it.
class StageClock {
 public:
  /// Starts now. `times` may be null.
  explicit StageClock(StageTimes* times) noexcept : times_(times) {
    if (times_ != nullptr) last_ = Clock::now();
  }

  /// What passed since the last call belongs to `stage`.
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
