// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/baselines/gpf.hpp"
#include "lab/baselines/settings.hpp"

namespace flagstone {

std::vector<Setting> settings_of(GpfConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "h_s: sensor above ground",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"noise_factor",
       &c.noise_factor,
       "points lower than -noise_factor * h_s are noise",
       {.low = 1, .high = 1000, .allow_infinity = true}},
      {"segments", &c.segments, "N_segs: segments along x", {.low = 1, .high = 1000}},
      {"segment_length",
       &c.segment_length,
       "length of a segment; the outermost are open",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"lowest_points",
       &c.lowest_points,
       "N_LPR: lowest points whose mean height is the lowest point representative",
       {.low = 1, .high = 1000000}},
      {"seed_height",
       &c.seed_height,
       "Th_seeds: seeds lie lower than the representative plus this",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"iterations", &c.iterations, "N_iter: plane fits a segment", {.low = 1, .high = 100}},
      {"distance_margin",
       &c.distance_margin,
       "Th_dist: ground lies lower than the plane plus this",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
  };
}

void GpfConfig::check() const {
  GpfConfig copy = *this;  // settings point into something that may be written to
  check_settings("gpf", settings_of(copy));
}

}  // namespace flagstone
