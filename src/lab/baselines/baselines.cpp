// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "lab/baselines/settings.hpp"

namespace flagstone {
namespace {

/// Returns `config` with exactly the terms of the ground likelihood that `name` lists after its
/// first plus sign, such as "czm+u+e".
PatchworkConfig with_terms_of(std::string_view name, PatchworkConfig config) {
  const std::string_view terms = name.substr(std::min(name.find('+'), name.size()));
  config.uprightness.enabled = terms.find("+u") != std::string_view::npos;
  config.elevation.enabled = terms.find("+e") != std::string_view::npos;
  config.flatness.enabled = terms.find("+f") != std::string_view::npos;
  return config;
}

/// R-GPF with the likelihood terms that its name lists.
Method r_gpf_row(std::string_view name, std::string_view title) {
  const auto config = [name] { return with_terms_of(name, r_gpf_config()); };
  return {.name = name,
          .title = title,
          .type = find_method("patchwork").type,
          .defaults = config,
          .for_sensor = [config](const Sensor& sensor) {
            return baselines::at_height_of(sensor, config());
          }};
}

/// Patchwork with the likelihood terms that its name lists.
Method patchwork_row(std::string_view name, std::string_view title) {
  return {.name = name,
          .title = title,
          .type = find_method("patchwork").type,
          .defaults = {},
          .for_sensor = {},
          .starts_from = "patchwork",
          .derive = [name](const MethodConfig& patchwork) {
            return with_terms_of(name, *patchwork.get_if<PatchworkConfig>());
          }};
}

}  // namespace

void register_baselines() {
  static const bool registered = [] {
    register_methods({baselines::ransac_method(), baselines::gpf_method(),
                      baselines::line_fit_method(), baselines::cascaded_method(),
                      r_gpf_row("r_gpf", "R-GPF"), r_gpf_row("r_gpf+u", "R-GPF + U"),
                      patchwork_row("czm+u", "CZM + U"), patchwork_row("czm+u+e", "CZM + U + E"),
                      patchwork_row("czm+u+e+f", "CZM + U + E + F")});
    return true;
  }();
  static_cast<void>(registered);
}

PatchworkConfig r_gpf_config() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  PatchworkConfig config;
  config.min_range = 0;
  config.zones = {{equal_rings(0, 80, 30), 108, -infinity}};
  config.noise_depth = infinity;
  config.noise_slope = 0;
  config.min_points = 6;
  config.sparse_bins_are_ground = false;
  config.seed_count = 20;
  config.seed_height = 0.5f;
  config.distance_margin = 0.15f;
  config.noise_margin = infinity;
  config.iterations = 3;
  config.uprightness = {.enabled = false, .angle = 45};
  config.elevation.enabled = false;
  config.flatness.enabled = false;
  return config;
}

std::span<const std::string_view> table_1_methods() noexcept {
  static constexpr std::array<std::string_view, 9> names = {
      "ransac", "gpf", "line_fit", "cascaded", "r_gpf", "r_gpf+u", "czm+u", "czm+u+e", "czm+u+e+f"};
  return names;
}

}  // namespace flagstone
