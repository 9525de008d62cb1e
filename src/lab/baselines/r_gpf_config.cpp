// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <limits>

#include "flagstone/baselines/r_gpf.hpp"

namespace flagstone {

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

}  // namespace flagstone
