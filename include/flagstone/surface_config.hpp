// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace flagstone {

struct Sensor;

/// Tests that decide which patches are ground.
struct PatchAcceptance {
  /// Minimum angle between the normal and the x-y plane, degrees, 0 to 90; values below 2.9 have
  /// the effect of 2.9. A larger angle is stricter and rejects steep banks. A patch with almost no
  /// points above it can be 8.7 degrees steeper.
  float upright_angle = 53.0f;

  /// Maximum clutter ratio: the number of points 19 to 89 cm above the plane, divided by the number
  /// within 12.5 cm of it; 0 to 1,000, or infinity for no limit. A wall or a bush has as many
  /// points just above its base as at its base; ground does not.
  float max_clutter_ratio = 0.5f;

  /// Maximum height of ground above -h_s, or `max_slope` times the range if that is larger; metres,
  /// 0 to 1,000. Patches whose plane is above the sensor are never ground.
  float max_height = 1.5f;
  /// Maximum slope of the ground as seen from below the sensor, m/m, 0 to 10; see `max_height`.
  float max_slope = 0.35f;

  /// Maximum height of a patch above the height that nearer patches predict, right next to them;
  /// metres, 0 to 100, or infinity for no limit. Below that height, the limit is 0.5 m larger.
  /// Also the maximum height above -h_s of a patch without neighbours, at any distance.
  float max_step = 0.5f;
  /// Added to `max_step` per metre of distance to the nearest of those patches, up to 15 m; m/m,
  /// 0 to 10.
  float max_step_per_metre = 0.15f;
};

/// Refinement of the surface with the points.
struct Refinement {
  /// Number of refinement levels, with cells of 2, 1, 0.5 and 0.25 m; 0 to 4. Fewer levels take
  /// less time.
  int levels = 4;

  /// Points within this distance of the surface correct its height, in cells of 2 m; metres, above
  /// 0, up to 10. A wider gate follows rougher ground, but also the objects on it.
  float gate = 0.45f;
  /// Ratio of the gate of each level to the gate of the previous level; above 0, up to 1.
  float gate_factor = 0.65f;
  /// Added to every gate per metre of range; m/m, 0 to 1.
  float gate_per_metre = 0.004f;

  /// Maximum clutter ratio of a cell: the number of points 18 to 88 cm above the surface, divided
  /// by the number at the surface; 0 to 1,000, or infinity for no limit. Cells with a larger
  /// ratio contain an obstacle: they show only that the ground is not above their lowest point.
  float max_clutter_ratio = 0.5f;

  /// Weight of that lower bound, compared with 1 for a measured cell; 0 to 1, 0 to disable it.
  float lower_bound_weight = 0.15f;
};

/// Limits that decide whether a point is ground.
struct PointRule {
  /// Points lower than this above the surface are ground; metres, 0 to 10.
  float margin = 0.24f;

  /// Used instead of `margin` near obstacles: in squares between four cell centres of the surface,
  /// with a point between 1.25 times `obstacle_height` and 2.5 m above it. If the highest point is
  /// only above 0.75 times `obstacle_height`, the mean of both margins is used. Metres, 0 to 10. A
  /// smaller value rejects more of the base of walls, but also loses ground next to them.
  float obstacle_margin = 0.06f;
  /// Height of an obstacle above the surface, metres, 0 to 2; see `obstacle_margin`.
  float obstacle_height = 0.72f;

  /// Points farther below the surface than this are noise, unless they form a separate plane;
  /// metres, 0 to 1,000.
  float noise_depth = 0.15f;
  /// Added to `noise_depth` per metre of range; m/m, 0 to 10.
  float noise_depth_per_metre = 0.02f;
};

/// Settings of the method `surface`. Only the sensor height and the range depend on the sensor.
struct SurfaceConfig {
  /// h_s: approximate height of the sensor above the ground, metres, -100 to 100. The method finds
  /// the exact height itself: an error of 0.3 m changes very few labels.
  float sensor_height = 1.73f;

  /// Points at this horizontal distance or farther are out of range; metres, 8 to 200.
  float max_range = 100.0f;

  /// Points lower than -h_s - noise_depth - noise_slope * range are noise and not used by any later
  /// stage. Metres, 0 to 1,000.
  float noise_depth = 2.0f;
  /// Maximum downward slope of the ground as seen from below the sensor, m/m, 0 to 10; see
  /// `noise_depth`.
  float noise_slope = 0.35f;

  PatchAcceptance acceptance{};  ///< which patches are ground
  Refinement refinement{};       ///< how the points refine the surface
  PointRule point{};             ///< which points are ground

  /// Settings derived from a sensor: its height and its range; see
  /// docs/explanation/settings-from-a-sensor.md. Throws std::invalid_argument if Sensor::check
  /// throws.
  static SurfaceConfig for_sensor(const Sensor& sensor);

  /// Settings derived from a known sensor at its usual height. Throws std::invalid_argument if
  /// there is no such sensor; see Sensor::named.
  static SurfaceConfig for_sensor(std::string_view name);

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;
};

}  // namespace flagstone
