// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/surface_config.hpp"

#include "library/surface/surface_settings.hpp"

namespace flagstone {

std::vector<Setting> settings_of(SurfaceConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "h_s: sensor above ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"max_range",
       &c.max_range,
       "points farther away are out of range",
       {.low = 8, .high = 200, .unit = "m"}},
      {"noise_depth",
       &c.noise_depth,
       "points lower than -h_s - noise_depth - noise_slope * range are noise",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"noise_slope",
       &c.noise_slope,
       "steepest descent of ground still believed",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"acceptance.upright_angle",
       &c.acceptance.upright_angle,
       "smallest angle between a patch's normal and the x-y plane",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"acceptance.contrast",
       &c.acceptance.contrast,
       "share of points just above a patch, of those in it, from which on it is no ground",
       {.low = 0, .high = 1000, .or_infinity = true}},
      {"acceptance.height",
       &c.acceptance.height,
       "how high above -h_s ground is believed",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"acceptance.rise",
       &c.acceptance.rise,
       "the same as a share of the range; the larger of both holds",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"acceptance.step",
       &c.acceptance.step,
       "how far above the height that nearer patches let expect a patch may lie",
       {.low = 0, .high = 100, .unit = "m", .or_infinity = true}},
      {"acceptance.step_growth",
       &c.acceptance.step_growth,
       "more of it for each metre to the nearest of them",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"refinement.levels",
       &c.refinement.levels,
       "levels of cells of 2, 1, 0.5, 0.25 m that refine the surface",
       {.low = 0, .high = 4}},
      {"refinement.gate",
       &c.refinement.gate,
       "points within this of the surface say where it is, in cells of 2 m",
       {.low = 0, .high = 10, .unit = "m", .without_low = true}},
      {"refinement.gate_factor",
       &c.refinement.gate_factor,
       "gate of a level as a share of that of the one before",
       {.low = 0, .high = 1, .without_low = true}},
      {"refinement.gate_growth",
       &c.refinement.gate_growth,
       "added to the gate for each metre of range",
       {.low = 0, .high = 1, .unit = "m/m"}},
      {"refinement.contrast",
       &c.refinement.contrast,
       "share of points just above the surface in a cell, of those at it, from which on something "
       "stands there",
       {.low = 0, .high = 1000, .or_infinity = true}},
      {"refinement.lower_bound_weight",
       &c.refinement.lower_bound_weight,
       "weight of the lowest point of such cells",
       {.low = 0, .high = 1}},
      {"point.margin",
       &c.point.margin,
       "ground lies lower than this above the surface",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.margin_at_obstacles",
       &c.point.margin_at_obstacles,
       "the same where something stands",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.standing_height",
       &c.point.standing_height,
       "how high, within a quarter, a point must be for something to stand there",
       {.low = 0, .high = 2, .unit = "m"}},
      {"point.noise_depth",
       &c.point.noise_depth,
       "points farther below the surface are noise",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"point.noise_growth",
       &c.point.noise_growth,
       "added to that for each metre of range",
       {.low = 0, .high = 10, .unit = "m/m"}},
  };
}

void SurfaceConfig::check() const {
  SurfaceConfig copy = *this;  // settings point into something that may be written to
  check_settings("surface", settings_of(copy));
}

}  // namespace flagstone
