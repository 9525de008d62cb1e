// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/fit_settings.hpp"

#include <cmath>

namespace flagstone::patchwork {

plane_fits::FitSettings fit_settings(const PatchworkConfig& config) noexcept {
  return {.seed_height = config.seed_height,
          .distance_margin = config.distance_margin,
          .noise_margin = config.noise_margin,
          .iterations = config.iterations,
          .keep_below_floor = config.keep_below_margin,
          .evaluate_final_set = config.evaluate_final_set};
}

std::vector<double> seed_floors(const PatchworkConfig& config) {
  std::vector<double> floors;
  for (const Zone& zone : config.zones) {
    // No margin is none at any sensor height, though infinity * 0 is not a number.
    const double margin = zone.height_margin;
    floors.push_back(std::isinf(margin) ? margin : margin * config.sensor_height);
  }
  return floors;
}

}  // namespace flagstone::patchwork
