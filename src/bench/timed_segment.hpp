// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "bench/contestant.hpp"
#include "flagstone/cloud_view.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone::bench {

/// Patchwork with one instruction set.
class TimedSegment final : public Contestant {
 public:
  enum class Stages : bool { not_timed, timed };

  /// Throws std::invalid_argument where configuration, threads or instruction set are not allowed.
  TimedSegment(std::span<const CloudView> scans, const PatchworkConfig& config, unsigned threads,
               std::string target, Stages stages = Stages::not_timed);

  Visit visit(std::size_t scan) override;

  /// Calls of operator new during the last visit.
  [[nodiscard]] std::size_t allocations() const noexcept { return allocations_; }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  Patchwork patchwork_;
  Segmentation result_;
  StageTimes stage_times_{};
  std::size_t allocations_ = 0;
};

}  // namespace flagstone::bench
