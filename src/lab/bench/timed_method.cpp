// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/timed_method.hpp"

#include <utility>

#include "flagstone/gravity_aligned_segmenter.hpp"
#include "flagstone/patchwork.hpp"
#include "flagstone/surface.hpp"

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

}  // namespace flagstone::bench
