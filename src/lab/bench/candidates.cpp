// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/candidates.hpp"

#include <stdexcept>
#include <utility>

#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"
#include "lab/bench/allocation_count.hpp"
#include "library/core/simd_target.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::bench {

namespace {

constexpr std::array patchwork_stages = {Stage::bin,     Stage::group, Stage::gather, Stage::seed,
                                         Stage::moments, Stage::solve, Stage::label};

constexpr std::array surface_stages = {Stage::bin,     Stage::group, Stage::gather, Stage::seed,
                                       Stage::moments, Stage::solve, Stage::join,   Stage::refine,
                                       Stage::measure, Stage::label};

template <class Method, class Config>
std::unique_ptr<Segmenter> make(const Config& config, unsigned threads, StageTimes* stage_times) {
  auto method = std::make_unique<Method>(config, threads);
  method->time_stages(stage_times);
  return method;
}

}  // namespace

std::string_view method_name(const TimedConfig& config) noexcept {
  return timed_methods[config.index()];
}

std::span<const Stage> stages_of(std::string_view method) noexcept {
  if (method == "surface") return surface_stages;
  return patchwork_stages;
}

float sensor_height(const TimedConfig& config) {
  return std::visit([](const auto& settings) { return settings.sensor_height; }, config);
}

std::unique_ptr<Segmenter> make_timed(const TimedConfig& config, const MountSettings& mount,
                                      unsigned threads, StageTimes* stage_times) {
  const auto* const surface = std::get_if<SurfaceConfig>(&config);
  std::unique_ptr<Segmenter> method =
      surface != nullptr ? make<Surface>(*surface, threads, stage_times)
                         : make<Patchwork>(std::get<PatchworkConfig>(config), threads, stage_times);
  return std::make_unique<GravityAlignedSegmenter>(std::move(method), sensor_height(config), mount);
}

namespace {

/// Selects the instruction set before the method is constructed, because constructors may depend on
/// it. Returns the name.
std::string used(std::string target) {
  use_simd_target(target);
  return target;
}

}  // namespace

TimedSegment::TimedSegment(std::span<const CloudView> scans, const TimedConfig& config,
                           const MountSettings& mount, unsigned threads, std::string target,
                           Stages stages)
    : scans_(scans),
      target_(used(std::move(target))),
      segmenter_(
          make_timed(config, mount, threads, stages == Stages::timed ? &stage_times_ : nullptr)) {}

Trial TimedSegment::run_trial(std::size_t scan) {
  use_simd_target(target_);
  stage_times_ = {};
  const std::size_t calls_before = allocation_count().calls;
  Stopwatch stopwatch;
  const Status status = segmenter_->segment(scans_[scan], result_);
  const double milliseconds = stopwatch.lap();
  allocations_ = allocation_count().calls - calls_before;
  if (status.code() == StatusCode::out_of_memory) {
    throw std::runtime_error(
        "not enough memory to segment a scan (benchmark fewer scans at a time)");
  }
  if (!status.ok()) throw std::runtime_error(status.message());
  return {
      .milliseconds = milliseconds, .ground = result_.count(Label::ground), .stages = stage_times_};
}

}  // namespace flagstone::bench
