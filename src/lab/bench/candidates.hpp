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

/// What came of one scan.
struct Trial {
  double milliseconds = 0;
  std::size_t ground = 0;  ///< points found ground
  StageTimes stages{};     ///< seconds; zeros where stages are not timed
};

/// Something that is timed on every scan in turn.
class Candidate {
 public:
  virtual ~Candidate() = default;
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;
  Candidate(Candidate&&) = delete;
  Candidate& operator=(Candidate&&) = delete;

  /// Does its work on scan number `scan`. Throws std::runtime_error, with one line, where it
  /// cannot.
  virtual Trial run_trial(std::size_t scan) = 0;

 protected:
  Candidate() = default;
};

/// Settings of a method that tells how long its stages take; which of them says which method.
using TimedConfig = std::variant<PatchworkConfig, SurfaceConfig>;

/// Names of these methods, as make_segmenter() knows them, in the order of `TimedConfig`.
inline constexpr std::array<std::string_view, 2> timed_methods = {"patchwork", "surface"};

/// Name of the method that these settings are of.
[[nodiscard]] std::string_view method_name(const TimedConfig& config) noexcept;

/// The stages that a method of `timed_methods` has, in order.
[[nodiscard]] std::span<const Stage> stages_of(std::string_view method) noexcept;

/// Height of the sensor, metres.
[[nodiscard]] float sensor_height(const TimedConfig& config);

/// The method with these settings, on clouds of this mount; making them level is none of the
/// stages. From then on every scan adds the seconds of its stages to `stage_times`; null times no
/// stage. Throws std::invalid_argument where configuration or threads are not allowed.
[[nodiscard]] std::unique_ptr<Segmenter> make_timed(const TimedConfig& config,
                                                    const MountSettings& mount, unsigned threads,
                                                    StageTimes* stage_times);

/// A method with one instruction set.
class TimedSegment final : public Candidate {
 public:
  enum class Stages : bool { not_timed, timed };

  /// Throws std::invalid_argument where configuration, threads or instruction set are not allowed.
  TimedSegment(std::span<const CloudView> scans, const TimedConfig& config,
               const MountSettings& mount, unsigned threads, std::string target,
               Stages stages = Stages::not_timed);

  Trial run_trial(std::size_t scan) override;

  /// Calls of operator new during the last trial.
  [[nodiscard]] std::size_t allocations() const noexcept { return allocations_; }

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  StageTimes stage_times_{};
  std::unique_ptr<Segmenter> segmenter_;
  Segmentation result_;
  std::size_t allocations_ = 0;
};

/// The read baseline, with one instruction set.
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

 private:
  std::span<const CloudView> scans_;
  std::string target_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace flagstone::bench
