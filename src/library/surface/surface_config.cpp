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
       "h_s: height of the sensor above the ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"max_range",
       &c.max_range,
       "points at this horizontal range or beyond are out of range",
       {.low = 8, .high = 200, .unit = "m"}},
      {"noise_depth",
       &c.noise_depth,
       "points lower than -h_s - noise_depth - noise_slope * range are noise",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"noise_slope",
       &c.noise_slope,
       "maximum downward slope of the ground: the noise limit (see noise_depth) is lower by "
       "this much per metre of range",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"acceptance.upright_angle",
       &c.acceptance.upright_angle,
       "minimum angle between the normal of a ground patch and the x-y plane",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"acceptance.max_clutter_ratio",
       &c.acceptance.max_clutter_ratio,
       "a patch is not ground if the number of points just above its plane exceeds this "
       "multiple of the number of points in its plane",
       {.low = 0, .high = 1000, .allow_infinity = true}},
      {"acceptance.max_height",
       &c.acceptance.max_height,
       "maximum height of a ground patch above -h_s (max_slope * range applies if it is "
       "larger)",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"acceptance.max_slope",
       &c.acceptance.max_slope,
       "maximum slope of the ground as seen from below the sensor: a ground patch may also "
       "be up to max_slope * range above -h_s",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"acceptance.max_step",
       &c.acceptance.max_step,
       "maximum height of a ground patch above the height predicted by nearer ground "
       "patches (0.5 m more is allowed below it)",
       {.low = 0, .high = 100, .unit = "m", .allow_infinity = true}},
      {"acceptance.max_step_per_metre",
       &c.acceptance.max_step_per_metre,
       "increase of max_step per metre of distance to the nearest ground patch, up to 15 m",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"refinement.levels",
       &c.refinement.levels,
       "number of levels that refine the surface, with cells of 2, 1, 0.5 and 0.25 m",
       {.low = 0, .high = 4}},
      {"refinement.gate",
       &c.refinement.gate,
       "points at most this far above or below the surface correct it, in cells of 2 m",
       {.low = 0, .high = 10, .unit = "m", .exclusive_min = true}},
      {"refinement.gate_factor",
       &c.refinement.gate_factor,
       "gate of each finer level, as a fraction of the gate of the level before",
       {.low = 0, .high = 1, .exclusive_min = true}},
      {"refinement.gate_per_metre",
       &c.refinement.gate_per_metre,
       "increase of the gate of every level per metre of range",
       {.low = 0, .high = 1, .unit = "m/m"}},
      {"refinement.max_clutter_ratio",
       &c.refinement.max_clutter_ratio,
       "a cell contains an obstacle if the number of points just above the surface exceeds "
       "this multiple of the number of points at the surface",
       {.low = 0, .high = 1000, .allow_infinity = true}},
      {"refinement.lower_bound_weight",
       &c.refinement.lower_bound_weight,
       "weight of the lowest point of a cell that contains an obstacle, relative to a fully "
       "observed cell",
       {.low = 0, .high = 1}},
      {"point.margin",
       &c.point.margin,
       "points lower than this above the surface are ground, in cells without an obstacle",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.obstacle_margin",
       &c.point.obstacle_margin,
       "points lower than this above the surface are ground, in cells that contain an "
       "obstacle",
       {.low = 0, .high = 10, .unit = "m"}},
      {"point.obstacle_height",
       &c.point.obstacle_height,
       "obstacle height above the surface: a cell with a point above 1.25 times this value "
       "uses obstacle_margin, above 0.75 times the mean of both margins",
       {.low = 0, .high = 2, .unit = "m"}},
      {"point.noise_depth",
       &c.point.noise_depth,
       "points farther than this below the surface are noise, unless they form a separate "
       "plane",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"point.noise_depth_per_metre",
       &c.point.noise_depth_per_metre,
       "increase of point.noise_depth per metre of range",
       {.low = 0, .high = 10, .unit = "m/m"}},
  };
}

void SurfaceConfig::check() const {
  SurfaceConfig copy = *this;  // settings refer to members that are not const
  check_settings("surface", settings_of(copy));
}

namespace {

constexpr double least_range = 8;  // the range that check() allows, metres
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
