// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <variant>

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/gpf.hpp"
#include "flagstone/baselines/line_fit.hpp"
#include "flagstone/baselines/r_gpf.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "flagstone/patchwork_config.hpp"
#include "flagstone/segmenter.hpp"
#include "flagstone/sensor.hpp"
#include "flagstone/surface_config.hpp"

/// Methods by name; the target is flagstone::baselines.
namespace flagstone {

/// The configuration of any method.
using MethodConfig = std::variant<PatchworkConfig, SurfaceConfig, RansacConfig, GpfConfig,
                                  LineFitConfig, CascadedConfig>;

/// What `make_segmenter` knows, in the order of the paper's Table I:
/// - `ransac`, `gpf`, `line_fit`, `cascaded`, `r_gpf`: what Patchwork is compared with;
/// - `r_gpf+u`: R-GPF judged by uprightness alone;
/// - `czm+u`, `czm+u+e`, `czm+u+e+f`: Patchwork's zones and fit with one, two and all three terms
///   of the ground likelihood;
/// - `patchwork`;
/// - `surface`, which is not in that table.
std::span<const std::string_view> method_names() noexcept;

/// The settings a method has if nobody says otherwise: those published, and for Patchwork the
/// preset `default`. Throws std::invalid_argument naming the methods there are.
MethodConfig default_config(std::string_view name);

/// The same for rows of the ablation made from `patchwork`: its zones and numbers, with the terms
/// of the ground likelihood that the name lists and no others. Other methods do not look at it.
MethodConfig default_config(std::string_view name, const PatchworkConfig& patchwork);

/// The settings a method has for a sensor: those derived from it where the method has a rule
/// (Patchwork's `for_sensor` for `patchwork` and czm+..., `surface`'s for `surface`), for
/// `cascaded` the sensor's beams, for the others the sensor's height. Throws std::invalid_argument
/// as these do.
MethodConfig default_config(std::string_view name, const Sensor& sensor);

/// Throws std::invalid_argument naming the field, its value and the range allowed.
void check(const MethodConfig& config);

/// A segmenter of that name with its default configuration.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name);

/// A segmenter of that name with this configuration. Throws std::invalid_argument for an unknown
/// name, a configuration of another method and a value out of range.
std::unique_ptr<Segmenter> make_segmenter(std::string_view name, const MethodConfig& config);

}  // namespace flagstone
