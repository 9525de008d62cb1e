// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace flagstone {

struct Sensor;

/// One zone Z_m of the Concentric Zone Model (paper, section III-B): rings around the sensor,
/// divided into sectors. The first zone begins at `min_range`, every other zone at the end of the
/// previous one.
struct Zone {
  /// Outer radius of each ring, innermost first, metres, ascending; the last one is L_max,m. The
  /// number of rings is N_r,m, 1 to 1,000. `equal_rings` computes the paper's rings of equal width.
  std::vector<float> ring_radii;

  /// N_theta,m: number of sectors per ring, within the field of view; 1 to 3,600.
  int sectors = 32;

  /// M_h of this zone: points below M_h * h_s are skipped as reflections when seeds are selected,
  /// eq. (5). Below -1; a lower value skips fewer points, minus infinity skips none. If h_s is 0 or
  /// less, points more than (-1 - M_h) * 1.73 m below the ground are skipped.
  float height_margin = -1.1f;
};

/// Outer radii of `count` rings of equal width from `inner` to `outer`, in metres; eq. (3).
std::vector<float> equal_rings(float inner, float outer, int count);

/// Horizontal field of view that the zones cover. Points outside it are out of range, because no
/// bin contains them.
struct FieldOfView {
  /// Start of sector 0, degrees counter-clockwise from x, -360 to 360.
  float begin = -180;
  /// Width, counter-clockwise from `begin`, degrees, above 0, up to 360. At 360 the zones surround
  /// the sensor.
  float width = 360;
};

/// phi, eq. (9): the normal of a ground patch must point up.
struct UprightnessTerm {
  /// If false, phi is 1 for every patch.
  bool enabled = true;
  /// theta_tau: minimum angle between the normal and the x-y plane, degrees, 0 to 90. A larger
  /// angle is stricter.
  float angle = 50.0f;
};

/// psi, eq. (10): near the sensor, the ground cannot be high.
/// `psi = 1 / (1 + exp((mean z - kappa(r)) / scale))`, `kappa(r) = -h_s + base * exp(growth * r)`.
struct ElevationTerm {
  /// If false, psi is 1 for every patch.
  bool enabled = true;
  /// Height above -h_s at which psi is 0.5, extrapolated to r = 0; metres, 0 to 100.
  float base = 0.333f;
  /// Exponential increase of that height with range, per metre, 0 to 1.
  float growth = 0.0987f;
  /// L_tau: psi is 1 for bins whose centre is beyond this radius; metres, 0 to 1,000.
  float range = 13.266f;
  /// Width of the step of psi, metres, above 0, up to 1,000. 1 is the paper's formula; near 0, psi
  /// becomes the step function of the authors' public code.
  float scale = 1.0f;
};

/// varphi, eq. (11): accepts patches that are too high but very flat, such as steep slopes.
/// varphi = gain * exp(-(sigma - threshold) / scale) if psi < 0.5, otherwise 1.
struct FlatnessTerm {
  /// If false, varphi is 1 for every patch.
  bool enabled = true;
  /// zeta: gain of a flat patch, above 1, up to 1,000.
  float gain = 1.2f;
  /// sigma_tau: maximum surface variable of a flat patch, one value per ring from the innermost
  /// outwards, 0 to 1/3, no unit. 1 to 1,000 values; the last one also applies to all rings beyond.
  std::vector<float> thresholds = {0.0005f, 0.000725f, 0.001f};
  /// Width of the step of varphi, in units of sigma, above 0, up to 1,000. 1 is the paper's
  /// formula; near 0, varphi becomes the step function of the authors' public code.
  float scale = 1e-7f;
};

/// Settings of Patchwork. The initial values are the preset `default`.
///
/// The presets are three sets of values for the same code:
/// - `paper`: the equations and numbers as printed;
/// - `reference`: the behaviour of the authors' public code;
/// - `default`: the values with the best measured results; see docs/explanation/patchwork.md.
struct PatchworkConfig {
  /// h_s: height of the origin of the cloud above the ground, metres, -100 to 100. Usually the
  /// origin is at the sensor. If the value is 0 or less, it is not: lengths that scale with the
  /// height of the sensor are then computed for a sensor 1.73 m above the ground. Results do not
  /// change if all points and sensor_height are shifted together.
  float sensor_height = 1.73f;

  // Concentric Zone Model, section III-B
  // -----------------------------------------------------------

  /// L_min: points nearer than this are out of range, metres, 0 to 1,000. Excludes the ego vehicle.
  float min_range = 2.7f;

  /// Z_1 to Z_Nz: zones from the sensor outwards, 1 to 16. The radius of the last ring, L_max, is
  /// at most 1,000 m. All zones together have at most 65,535 bins.
  std::vector<Zone> zones = default_zones();

  /// Horizontal field of view. Points outside it are out of range.
  FieldOfView field_of_view{};

  // Noise: points below any possible ground
  // ------------------------------------------------------------------------

  /// Points lower than -h_s - noise_depth - noise_slope * r are noise, where r is the outer radius
  /// of the ring of the point. Metres, 0 to 1,000, or infinity for no such limit.
  float noise_depth = 2.0f;

  /// Maximum downward slope of the ground as seen from below the sensor, m/m, 0 to 10; see
  /// `noise_depth`.
  float noise_slope = 0.1f;

  // Region-wise Ground Plane Fitting, section III-C
  // ------------------------------------------------

  /// Bins with fewer points than this get no plane, 3 to 1,000,000.
  int min_points = 6;

  /// Label of the points in bins with fewer than `min_points` points: `ground` if true, `nonground`
  /// if false.
  bool sparse_bins_are_ground = false;

  /// N_seed: number of lowest points whose mean height starts the fit, 1 to 1,000.
  int seed_count = 20;

  /// z_seed: points lower than the mean height of the seeds plus this form the first ground set,
  /// eq. (5); metres, above 0, up to 100.
  float seed_height = 0.4f;

  /// Whether points below the height margin of a zone can be in the first ground set. They are
  /// never used for the mean height of the seeds.
  bool keep_below_margin = true;

  /// M_d: points less than this above the plane form its ground set, eq. (6); metres, above 0, up
  /// to 100.
  float distance_margin = 0.125f;

  /// Points farther than this below the plane are excluded from its ground set, and are noise if
  /// the patch is ground; metres, above 0, up to 1,000, or infinity for no lower bound, as in the
  /// paper.
  float noise_margin = 0.5f;

  /// Points of a ground patch farther than this below its plane are ground if they form a separate
  /// plane, such as the bottom of a ditch, and noise otherwise; metres, above 0, up to 1,000. At
  /// infinity this test is off and only noise_margin applies. Values above noise_margin have the
  /// effect of noise_margin.
  float lower_plane_margin = 0.25f;

  /// Number of plane fits per bin, 1 to 100. The paper and common implementations use 3.
  int iterations = 3;

  // Ground Likelihood Estimation, section III-D
  // ----------------------------------------------------

  /// Ground set that the likelihood evaluates. True: the final set, as in the paper, which takes
  /// one more fit. False: the set that the last plane was fitted to, as in the public code.
  bool evaluate_final_set = false;

  UprightnessTerm uprightness{};  ///< phi, eq. (9)
  ElevationTerm elevation{};      ///< psi, eq. (10)
  FlatnessTerm flatness{};        ///< varphi, eq. (11)

  /// The preset with that name. Throws std::invalid_argument listing the presets if there is none.
  static PatchworkConfig preset(std::string_view name);

  /// Names of the presets: default, paper, reference.
  static std::span<const std::string_view> preset_names() noexcept;

  /// Settings derived from a sensor: zones, field of view, ranges and margins that fit its beams
  /// and its height. docs/explanation/settings-from-a-sensor.md describes the rule. All other
  /// settings are those of `default`. Throws std::invalid_argument if Sensor::check throws, if the
  /// height is less than 0.01 m, or if no beam meets flat ground within the range of the sensor.
  static PatchworkConfig for_sensor(const Sensor& sensor);

  /// Settings derived from a known sensor at its usual height. Throws std::invalid_argument if
  /// there is no such sensor; see Sensor::named.
  static PatchworkConfig for_sensor(std::string_view name);

  /// Checks all values. Throws std::invalid_argument naming the field, its value and the allowed
  /// range, for the first value out of range.
  void check() const;

  /// Zones of the preset `default`.
  static std::vector<Zone> default_zones();
};

}  // namespace flagstone
