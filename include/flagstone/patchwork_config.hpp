// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace flagstone {

struct Sensor;

/// One zone Z_m of the Concentric Zone Model (paper, section III-B): rings of sectors around the
/// sensor. A zone begins where the one before it ends, the first at `min_range`.
struct Zone {
  /// Outer radius of each ring, innermost first; the last one is L_max,m. Metres, ascending.
  /// Its length is N_r,m, 1 to 1,000 rings. `equal_rings` gives the paper's equal widths.
  std::vector<float> ring_radii;

  /// N_theta,m: sectors a ring is cut into, within the field of view; 1 to 3,600.
  int sectors = 32;

  /// M_h of this zone: when seeds are chosen, eq. (5), points below M_h * h_s are skipped as
  /// reflections. Below -1; the lower, the looser. Minus infinity skips none. If h_s is 0 or less,
  /// points are skipped that are (-1 - M_h) * 1.73 m below the ground.
  float height_margin = -1.1f;
};

/// `count` rings of equal width from `inner` to `outer` metres: the outer radii, as eq. (3) has
/// them.
std::vector<float> equal_rings(float inner, float outer, int count);

/// What of the full turn the zones cover. Points outside it are out of range: a sensor that sees
/// them is not the one that was configured, and no bin beside them would be the right one.
struct FieldOfView {
  /// Where sector 0 begins, degrees counter-clockwise from x, -360 to 360.
  float begin = -180;
  /// How far it goes from there, counter-clockwise, degrees, above 0, up to 360. At 360 the zones
  /// close around the sensor.
  float width = 360;
};

/// phi, eq. (9): the patch's normal must stand up.
struct UprightnessTerm {
  /// Where false, phi is 1 for every patch.
  bool enabled = true;
  /// theta_tau: smallest angle between the normal and the x-y plane, degrees, 0 to 90. The larger,
  /// the stricter.
  float angle = 50.0f;
};

/// psi, eq. (10): near the sensor the ground cannot be high.
/// psi = 1 / (1 + exp((mean z - kappa(r)) / scale)), kappa(r) = -h_s + base * exp(growth * r).
struct ElevationTerm {
  /// Where false, psi is 1 for every patch.
  bool enabled = true;
  /// Height above -h_s at which psi is 0.5, extrapolated to r = 0; metres, 0 to 100.
  float base = 0.333f;
  /// How fast that height grows with range, per metre, 0 to 1.
  float growth = 0.0987f;
  /// L_tau: bins centred beyond this radius are not judged by elevation; metres, 0 to 1,000.
  float range = 13.266f;
  /// Width of the step, metres, above 0, up to 1,000. 1 is the paper's formula; towards 0 psi
  /// becomes the step of the public code.
  float scale = 1.0f;
};

/// varphi, eq. (11): brings back patches that are too high but definitely even: steep slopes.
/// varphi = gain * exp(-(sigma - threshold) / scale) where psi < 0.5, else 1.
struct FlatnessTerm {
  /// Where false, varphi is 1 for every patch.
  bool enabled = true;
  /// zeta: above 1, up to 1,000.
  float gain = 1.2f;
  /// sigma_tau of each ring from the innermost on; the last one holds for the rings beyond. Each 0
  /// to 1/3, no unit; 1 to 1,000 of them.
  std::vector<float> thresholds = {0.0005f, 0.000725f, 0.001f};
  /// Width of the step in units of sigma, above 0, up to 1,000. 1 is the paper's formula; towards 0
  /// varphi becomes the step of the public code.
  float scale = 1e-7f;
};

/// Every setting of Patchwork. The initial values are the preset `default`.
///
/// Three presets of one parameter set, never three code paths:
/// - `paper`: the equations and numbers as printed;
/// - `reference`: how the authors' public code behaves;
/// - `default`: what measures best; see docs/explanation/patchwork.md.
struct PatchworkConfig {
  /// h_s: height of the cloud's origin above the ground, metres, -100 to 100. Usually the origin is
  /// in the sensor. At 0 and below it is not: lengths that grow with the sensor's height are then
  /// those of a sensor 1.73 m above the ground, and results do not change when all points and
  /// sensor_height move together.
  float sensor_height = 1.73f;

  // Concentric Zone Model, section III-B
  // -----------------------------------------------------------

  /// L_min: nearer points are out of range, metres, 0 to 1,000. Keeps the own vehicle out.
  float min_range = 2.7f;

  /// Z_1 .. Z_Nz, from the sensor outward; 1 to 16. L_max is the last ring's radius, at most 1,000
  /// m; at most 65,535 bins in all.
  std::vector<Zone> zones = default_zones();

  /// Points outside it are out of range.
  FieldOfView field_of_view{};

  // Points below any ground
  // ------------------------------------------------------------------------

  /// Points lower than -h_s - noise_depth - noise_slope * r are noise, with r the outer radius of
  /// the point's ring. Metres, 0 to 1,000 or infinity for none.
  float noise_depth = 2.0f;

  /// Steepest descent of ground from below the sensor that is still believed, metres a metre, 0
  /// to 10.
  float noise_slope = 0.1f;

  // Region-wise Ground Plane Fitting, section III-C
  // ------------------------------------------------

  /// Bins with fewer points than this are not fitted, 3 to 1,000,000.
  int min_points = 6;

  /// What the points of such bins are: ground, or nonground.
  bool sparse_bins_are_ground = false;

  /// N_seed: the lowest points whose mean height starts the fit, 1 to 1,000.
  int seed_count = 20;

  /// z_seed: points lower than the seeds' mean plus this form the first ground set, eq. (5);
  /// metres, above 0, up to 100.
  float seed_height = 0.4f;

  /// Whether points below a zone's height margin may enter the first ground set. They never count
  /// for the seeds' mean.
  bool keep_below_margin = true;

  /// M_d: points less than this above the plane are its ground set, eq. (6); metres, above
  /// 0, up to 100.
  float distance_margin = 0.125f;

  /// Points farther than this below the plane are left out of its ground set, and are noise if the
  /// patch is ground; metres, above 0, up to 1,000, or infinity as in the paper, whose sets have no
  /// lower bound.
  float noise_margin = 0.5f;

  /// Points of a ground patch farther than this below its plane are ground where they lie in a
  /// plane of their own, as the bottom of a ditch does, else noise; metres, above 0, up to 1,000,
  /// or infinity for neither: then noise_margin alone decides. No more than noise_margin counts.
  float lower_plane_margin = 0.25f;

  /// Plane fits a bin; the paper's and everybody's 3. 1 to 100.
  int iterations = 3;

  // Ground Likelihood Estimation, section III-D
  // ----------------------------------------------------

  /// Whether the likelihood judges the final ground set, as the paper has it, at the price of one
  /// more fit, or the set that the last plane was fitted to, as the public code does.
  bool evaluate_final_set = false;

  UprightnessTerm uprightness{};  ///< phi, eq. (9)
  ElevationTerm elevation{};      ///< psi, eq. (10)
  FlatnessTerm flatness{};        ///< varphi, eq. (11)

  /// The preset of that name. Throws std::invalid_argument naming the presets there are.
  static PatchworkConfig preset(std::string_view name);

  /// Names of the presets: default, paper, reference.
  static std::span<const std::string_view> preset_names() noexcept;

  /// Settings derived from a sensor: zones, field of view, ranges and margins that suit its beams
  /// and its height, by the rule of docs/reference/sensors.md. What the rule does not speak of is as in
  /// `default`. Throws std::invalid_argument where the sensor's check() does, and where its height
  /// is 0 or none of its beams meets flat ground within its range.
  static PatchworkConfig for_sensor(const Sensor& sensor);

  /// The same for a known sensor at its usual height; see Sensor::named.
  static PatchworkConfig for_sensor(std::string_view name);

  /// Throws std::invalid_argument naming the field, its value and the range allowed, for the first
  /// value out of range.
  void check() const;

  /// Zones of the preset `default`.
  static std::vector<Zone> default_zones();
};

}  // namespace flagstone
