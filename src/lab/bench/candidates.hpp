// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"
#include "flagstone/surface_config.hpp"
#include "lab/bench/read_baseline.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::bench {

/// Result of one run on one scan.
struct Trial {
  double milliseconds = 0;
  std::size_t ground = 0;  ///< number of points labelled ground
  StageTimes stages{};     ///< seconds; zero if stages are not timed
};

/// A program or function that is timed on every scan in turn.
class Candidate {
 public:
  virtual ~Candidate() = default;
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;
  Candidate(Candidate&&) = delete;
  Candidate& operator=(Candidate&&) = delete;

  /// Processes scan number `scan`. Throws std::runtime_error with a one-line message on failure.
  virtual Trial run_trial(std::size_t scan) = 0;

  /// Number of untimed passes over all scans directly before each timed pass.
  [[nodiscard]] virtual std::size_t untimed_passes() const noexcept { return 0; }

 protected:
  Candidate() = default;
};

/// Settings of a method that reports the times of its stages. The type of the settings selects the
/// method.
using TimedConfig = std::variant<PatchworkConfig, SurfaceConfig>;

/// Names of these methods for make_segmenter(), in the order of `TimedConfig`.
inline constexpr std::array<std::string_view, 2> timed_methods = {"patchwork", "surface"};

/// Name of the method with these settings.
[[nodiscard]] std::string_view method_name(const TimedConfig& config) noexcept;

/// The stages of a method in `timed_methods`, in order.
[[nodiscard]] std::span<const Stage> stages_of(std::string_view method) noexcept;

/// Height of the sensor, metres.
[[nodiscard]] float sensor_height(const TimedConfig& config);

/// Makes a method with these settings for clouds with this mounting pose. Every scan adds the
/// seconds of its stages to `stage_times`; null disables stage times. Gravity alignment belongs to
/// no stage. Throws std::invalid_argument for an invalid configuration or number of threads.
[[nodiscard]] std::unique_ptr<Segmenter> make_timed(const TimedConfig& config,
                                                    const MountSettings& mount, unsigned threads,
                                                    StageTimes* stage_times);

/// A method, run with one instruction set.
class TimedSegment final : public Candidate {
 public:
  enum class Stages : bool { not_timed, timed };

  /// Throws std::invalid_argument for an invalid configuration, number of threads or instruction
  /// set.
  TimedSegment(std::span<const CloudView> scans, const TimedConfig& config,
               const MountSettings& mount, unsigned threads, std::string target,
               Stages stages = Stages::not_timed);

  Trial run_trial(std::size_t scan) override;

  /// Number of calls of operator new during the last trial.
  [[nodiscard]] std::size_t allocations() const noexcept { return allocations_; }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  StageTimes stage_times_{};
  std::unique_ptr<Segmenter> segmenter_;
  Segmentation result_;
  std::size_t allocations_ = 0;
};

/// The read-only baseline, run with one instruction set. An untimed pass comes before each timed
/// one. Directly after another candidate, the time would depend on how much of the scans that
/// candidate had left in the cache.
class TimedReadBaseline final : public Candidate {
 public:
  TimedReadBaseline(std::span<const CloudView> scans, std::string target)
      : scans_(scans), target_(std::move(target)) {
    std::size_t largest = 0;
    for (const CloudView& scan : scans) largest = std::max(largest, scan.size());
    bytes_.resize(largest);
  }

  Trial run_trial(std::size_t scan) override {
    use_simd_target(target_);
    Stopwatch stopwatch;
    read_baseline(scans_[scan], bytes_);
    return {.milliseconds = stopwatch.lap()};
  }

  [[nodiscard]] std::size_t untimed_passes() const noexcept override { return 1; }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace flagstone::bench
