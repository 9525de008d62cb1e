// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/surface_config.hpp"

#include <algorithm>

#include "flagstone/sensor.hpp"
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
      {"acceptance.max_clutter_ratio",
       &c.acceptance.max_clutter_ratio,
       "share of points just above a patch, of those in it, from which on it is no ground",
       {.low = 0, .high = 1000, .allow_infinity = true}},
      {"acceptance.max_height",
       &c.acceptance.max_height,
       "how high above -h_s ground is believed",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"acceptance.max_slope",
       &c.acceptance.max_slope,
       "the same as a share of the range; the larger of both holds",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"acceptance.max_step",
       &c.acceptance.max_step,
       "how far above the height that nearer patches let expect a patch may lie",
       {.low = 0, .high = 100, .unit = "m", .allow_infinity = true}},
      {"acceptance.max_step_per_metre",
       &c.acceptance.max_step_per_metre,
       "more of it for each metre to the nearest of them",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"refinement.levels",
       &c.refinement.levels,
       "levels of cells of 2, 1, 0.5, 0.25 m that refine the surface",
       {.low = 0, .high = 4}},
      {"refinement.gate",
       &c.refinement.gate,
       "points within this of the surface say where it is, in cells of 2 m",
       {.low = 0, .high = 10, .unit = "m", .exclusive_min = true}},
      {"refinement.gate_factor",
       &c.refinement.gate_factor,
       "gate of a level as a share of that of the one before",
       {.low = 0, .high = 1, .exclusive_min = true}},
      {"refinement.gate_per_metre",
       &c.refinement.gate_per_metre,
       "added to the gate for each metre of range",
       {.low = 0, .high = 1, .unit = "m/m"}},
      {"refinement.max_clutter_ratio",
       &c.refinement.max_clutter_ratio,
       "share of points just above the surface in a cell, of those at it, from which on something "
       "stands there",
       {.low = 0, .high = 1000, .allow_infinity = true}},
      {"refinement.lower_bound_weight",
       &c.refinement.lower_bound_weight,
       "weight of the lowest point of such cells",
       {.low = 0, .high = 1}},
      {"point.margin",
       &c.point.margin,
       "ground lies lower than this above the surface",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.obstacle_margin",
       &c.point.obstacle_margin,
       "the same where something stands",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.obstacle_height",
       &c.point.obstacle_height,
       "how high, within a quarter, a point must be for something to stand there",
       {.low = 0, .high = 2, .unit = "m"}},
      {"point.noise_depth",
       &c.point.noise_depth,
       "points farther below the surface are noise",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"point.noise_depth_per_metre",
       &c.point.noise_depth_per_metre,
       "added to that for each metre of range",
       {.low = 0, .high = 10, .unit = "m/m"}},
  };
}

void SurfaceConfig::check() const {
  SurfaceConfig copy = *this;  // settings point into something that may be written to
  check_settings("surface", settings_of(copy));
}

namespace {

constexpr double least_range = 8;  // what check() allows, metres
constexpr double most_range = 200;

}  // namespace

SurfaceConfig SurfaceConfig::for_sensor(const Sensor& sensor) {
  sensor.check();
  SurfaceConfig config;
  config.sensor_height = static_cast<float>(sensor.height);
  config.max_range = static_cast<float>(std::clamp(sensor.max_range, least_range, most_range));
  return config;
}

SurfaceConfig SurfaceConfig::for_sensor(std::string_view name) {
  return for_sensor(Sensor::named(name));
}

}  // namespace flagstone
