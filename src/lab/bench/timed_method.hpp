// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>
#include <variant>

#include "flagstone/mount.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/stage_times.hpp"
#include "flagstone/surface_config.hpp"

namespace flagstone::bench {

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

}  // namespace flagstone::bench
