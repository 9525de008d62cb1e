// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace flagstone {

struct Sensor;

/// Which patches are believed to be ground.
struct PatchAcceptance {
  /// Smallest angle between the normal and the x-y plane, degrees, 0 to 90; below 2.9 it counts as
  /// 2.9. The larger, the stricter: steep banks are lost.
  float upright_angle = 53.0f;

  /// As many points as this share of those within 12.5 cm of the plane may lie 19 to 89 cm above
  /// it; 0 to 1,000, or infinity for no limit. A wall or bush has as many just above its foot as in
  /// it, ground has not.
  float max_clutter_ratio = 0.6f;

  /// Ground is believed up to this height above -h_s, or up to `max_slope` times the range if that
  /// is more; metres, 0 to 1,000.
  float max_height = 1.5f;
  /// Metres a metre, 0 to 10.
  float max_slope = 0.35f;

  /// How far a patch may lie above what nearer patches let expect (0.5 m more below it), next to
  /// them; metres, 0 to 100, or infinity for no limit.
  float max_step = 0.5f;
  /// How much more for each metre to the nearest of them, up to 15 m; metres a metre, 0 to 10.
  float max_step_per_metre = 0.15f;
};

/// How the surface follows the points closer than the patches do.
struct Refinement {
  /// Levels of cells of 2, 1, 0.5 and 0.25 m that refine it, 0 to 4. Fewer take less time.
  int levels = 4;

  /// Points within this of the surface say where it really is, in cells of 2 m; metres, above 0, up
  /// to 10. A wider gate follows rougher ground, and more of what stands on it.
  float gate = 0.45f;
  /// What the gate of one level is of that of the one before; above 0, up to 1.
  float gate_factor = 0.65f;
  /// Added to every gate for each metre of range; metres a metre, 0 to 1.
  float gate_per_metre = 0.004f;

  /// In a cell, as many points as this share of those at the surface may lie 18 to 88 cm above it;
  /// 0 to 1,000, or infinity for no limit. Where there are more, something stands there, and the
  /// cell says only that the ground is not above its lowest point.
  float max_clutter_ratio = 0.5f;

  /// Weight of that lower bound beside a measured cell's 1; 0 to 1, 0 for none.
  float lower_bound_weight = 0.15f;
};

/// When a point is ground.
struct PointRule {
  /// Points lower than this above the surface are ground; metres, 0 to 10.
  float margin = 0.24f;

  /// The same where something stands: in cells of 0.5 m with a point 1.25 times `obstacle_height`
  /// to 2.5 m above the surface. Where the highest lies above 0.75 times `obstacle_height` only,
  /// the mean of both margins holds. Metres, 0 to 10. Smaller keeps feet of walls out, and loses
  /// ground beside them.
  float obstacle_margin = 0.06f;
  /// Metres, 0 to 2.
  float obstacle_height = 0.72f;

  /// Points farther below the surface are noise; metres, 0 to 1,000.
  float noise_depth = 0.15f;
  /// Added to that for each metre of range; metres a metre, 0 to 10.
  float noise_depth_per_metre = 0.02f;
};

/// Settings of the method `surface`. They are the same for every sensor but for its height.
struct SurfaceConfig {
  /// h_s: height of the sensor above the ground, metres, -100 to 100. The surface finds its height
  /// by itself; this says where to begin. 0.3 m off changes hardly a label.
  float sensor_height = 1.73f;

  /// Points as far away as this, seen from above, or farther are out of range; metres, 8 to 200.
  float max_range = 100.0f;

  /// Points lower than -h_s - noise_depth - noise_slope * range are noise before all else. Metres,
  /// 0 to 1,000.
  float noise_depth = 2.0f;
  /// Steepest descent of ground from below the sensor that is still believed, metres a metre, 0 to
  /// 10.
  float noise_slope = 0.35f;

  PatchAcceptance acceptance{};  ///< which patches the surface is made of
  Refinement refinement{};       ///< how it follows the points
  PointRule point{};             ///< which points are ground

  /// Settings derived from a sensor: its height and its range; see docs/reference/sensors.md. Throws
  /// std::invalid_argument where the sensor's check() does.
  static SurfaceConfig for_sensor(const Sensor& sensor);

  /// The same for a known sensor at its usual height; see Sensor::named.
  static SurfaceConfig for_sensor(std::string_view name);

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;
};

}  // namespace flagstone
