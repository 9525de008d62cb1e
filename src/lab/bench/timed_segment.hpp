// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "flagstone/cloud_view.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"
#include "lab/bench/contestant.hpp"
#include "lab/bench/timed_method.hpp"

namespace flagstone::bench {

/// A method with one instruction set.
class TimedSegment final : public Contestant {
 public:
  enum class Stages : bool { not_timed, timed };

  /// Throws std::invalid_argument where configuration, threads or instruction set are not allowed.
  TimedSegment(std::span<const CloudView> scans, const TimedConfig& config,
               const MountSettings& mount, unsigned threads, std::string target,
               Stages stages = Stages::not_timed);

  Visit visit(std::size_t scan) override;

  /// Calls of operator new during the last visit.
  [[nodiscard]] std::size_t allocations() const noexcept { return allocations_; }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  StageTimes stage_times_{};
  std::unique_ptr<Segmenter> segmenter_;
  Segmentation result_;
  std::size_t allocations_ = 0;
};

}  // namespace flagstone::bench
