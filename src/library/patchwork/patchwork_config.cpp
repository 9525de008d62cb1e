// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork_config.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "library/core/did_you_mean.hpp"
#include "library/patchwork/patchwork_settings.hpp"

namespace flagstone {
namespace {

constexpr std::string_view method = "patchwork";

/// Checks one zone that begins at `inner` metres. Returns its outer radius, metres.
float check_zone(const Zone& zone, const std::string& name, float inner) {
  check_number(method, "length of " + name + ".ring_radii",
               static_cast<double>(zone.ring_radii.size()),
               {.low = 1, .high = 1000, .unit = "rings"});
  for (std::size_t i = 0; i < zone.ring_radii.size(); ++i) {
    check_number(method, name + ".ring_radii[" + std::to_string(i) + "]", zone.ring_radii[i],
                 {.low = inner,
                  .high = 1000,
                  .unit = "m",
                  .exclusive_min = true,
                  .remark = "ascending from min_range"});
    inner = zone.ring_radii[i];
  }
  check_number(method, name + ".sectors", zone.sectors, {.low = 1, .high = 3600});
  if (!(zone.height_margin < -1.0f)) {
    throw_out_of_range(method, name + ".height_margin", zone.height_margin,
                       "below -1, or -inf for no margin");
  }
  return inner;
}

void check_zones(const PatchworkConfig& config) {
  check_number(method, "number of zones", static_cast<double>(config.zones.size()),
               {.low = 1, .high = 16});
  float inner = config.min_range;
  std::size_t bins = 0;
  for (std::size_t m = 0; m < config.zones.size(); ++m) {
    const Zone& zone = config.zones[m];
    inner = check_zone(zone, "zones[" + std::to_string(m) + "]", inner);
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  check_number(method, "number of bins (rings times sectors over all zones)",
               static_cast<double>(bins), {.low = 1, .high = 65535});
}

}  // namespace

std::vector<float> equal_rings(float inner, float outer, int count) {
  std::vector<float> radii;
  radii.reserve(static_cast<std::size_t>(std::max(count, 0)));
  for (int i = 1; i <= count; ++i) {
    const double fraction = static_cast<double>(i) / count;
    radii.push_back(static_cast<float>(inner + fraction * (static_cast<double>(outer) - inner)));
  }
  return radii;
}

std::vector<Setting> settings_of(PatchworkConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "h_s: height of the sensor above the ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"min_range",
       &c.min_range,
       "L_min: points nearer than this are out of range",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"noise_depth",
       &c.noise_depth,
       "points lower than -h_s - noise_depth - noise_slope * r are noise, where r is the outer "
       "radius of their ring",
       {.low = 0, .high = 1000, .unit = "m", .allow_infinity = true}},
      {"noise_slope",
       &c.noise_slope,
       "maximum downward slope of the ground: the noise limit (see noise_depth) is lower by this "
       "much per metre of range",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"min_points",
       &c.min_points,
       "minimum number of points in a bin; bins with fewer points get no plane",
       {.low = 3, .high = 1000000}},
      {"sparse_bins_are_ground", &c.sparse_bins_are_ground,
       "whether the points in bins with fewer than min_points points are ground"},
      {"seed_count",
       &c.seed_count,
       "N_seed: number of lowest points in a bin whose mean height starts the fit",
       {.low = 1, .high = 1000}},
      {"seed_height",
       &c.seed_height,
       "z_seed: points lower than the mean height of the seeds plus this value form the first "
       "ground set, eq. (5)",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"keep_below_margin", &c.keep_below_margin,
       "whether points below the height margin of their zone can be in the first ground set"},
      {"distance_margin",
       &c.distance_margin,
       "M_d: points less than this above the plane form its ground set, eq. (6)",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"noise_margin",
       &c.noise_margin,
       "points farther than this below the plane are excluded from its ground set, and are noise "
       "if the patch is ground",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true, .allow_infinity = true}},
      {"lower_plane_margin",
       &c.lower_plane_margin,
       "points farther than this below the plane of a ground patch are ground if they form a "
       "separate plane, otherwise noise",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true, .allow_infinity = true}},
      {"iterations", &c.iterations, "number of plane fits per bin", {.low = 1, .high = 100}},
      {"evaluate_final_set", &c.evaluate_final_set,
       "whether the likelihood evaluates the final ground set (true, as in the paper) or the set "
       "of the last plane fit (false, as in the public code)"},
      {"field_of_view.begin",
       &c.field_of_view.begin,
       "start of the field of view and of sector 0, counter-clockwise from x",
       {.low = -360, .high = 360, .unit = "degrees"}},
      {"field_of_view.width",
       &c.field_of_view.width,
       "width of the field of view, counter-clockwise from field_of_view.begin; points outside it "
       "are out of range",
       {.low = 0, .high = 360, .unit = "degrees", .exclusive_min = true}},
      {"uprightness.enabled", &c.uprightness.enabled,
       "whether phi, eq. (9), is used: the normal of a ground patch must point up"},
      {"uprightness.angle",
       &c.uprightness.angle,
       "theta_tau: minimum angle between the normal of a ground patch and the x-y plane",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"elevation.enabled", &c.elevation.enabled,
       "whether psi, eq. (10), is used: near the sensor, a ground patch must not be high"},
      {"elevation.base",
       &c.elevation.base,
       "height above -h_s at which psi is 0.5, extrapolated to r = 0: "
       "`kappa(r) = -h_s + base * exp(growth * r)`",
       {.low = 0, .high = 100, .unit = "m"}},
      {"elevation.growth",
       &c.elevation.growth,
       "exponential increase of kappa(r) with the range r; see elevation.base",
       {.low = 0, .high = 1, .unit = "per m"}},
      {"elevation.range",
       &c.elevation.range,
       "L_tau: psi is 1 for bins whose centre is farther from the sensor than this",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"elevation.scale",
       &c.elevation.scale,
       "width of the step of psi; 1 is the paper's formula",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"flatness.enabled", &c.flatness.enabled,
       "whether varphi, eq. (11), is used: it accepts patches that are too high but very flat"},
      {"flatness.gain",
       &c.flatness.gain,
       "zeta: gain of varphi for patches that are too high",
       {.low = 1, .high = 1000, .exclusive_min = true}},
      {"flatness.thresholds",
       &c.flatness.thresholds,
       "sigma_tau: maximum surface variable of a flat patch, one value per ring from the innermost "
       "outwards; the last value applies to all rings beyond",
       {.low = 0, .high = 1.0 / 3}},
      {"flatness.scale",
       &c.flatness.scale,
       "width of the step of varphi, in units of sigma; 1 is the paper's formula",
       {.low = 0, .high = 1000, .exclusive_min = true}},
  };
}

void PatchworkConfig::check() const {
  PatchworkConfig copy = *this;  // settings_of() needs an object that can be modified
  check_settings(method, settings_of(copy));
  check_zones(*this);
}

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// One zone for each element of the three lists.
std::vector<Zone> make_zones(const std::vector<std::vector<float>>& ring_radii,
                             const std::vector<int>& sectors,
                             const std::vector<float>& height_margins) {
  std::vector<Zone> zones;
  zones.reserve(ring_radii.size());
  for (std::size_t m = 0; m < ring_radii.size(); ++m) {
    zones.push_back({ring_radii[m], sectors[m], height_margins[m]});
  }
  return zones;
}

/// 2, 4, 4 and 4 rings between the boundaries that section III-B derives from L_min and L_max.
std::vector<std::vector<float>> paper_rings(float l_min, float l_max) {
  const float l_2 = (7 * l_min + l_max) / 8;
  const float l_3 = (3 * l_min + l_max) / 4;
  const float l_4 = (l_min + l_max) / 2;
  return {equal_rings(l_min, l_2, 2), equal_rings(l_2, l_3, 4), equal_rings(l_3, l_4, 4),
          equal_rings(l_4, l_max, 4)};
}

/// Section IV-C. The paper does not give M_h beyond Z_1, kappa or zeta. Here, M_h decreases so that
/// ground with a downward slope of 20 % is kept, kappa passes through the elevation steps of the
/// authors' code at the ring centres, and zeta is ours.
PatchworkConfig paper() {
  PatchworkConfig config;
  config.zones = make_zones(paper_rings(2.7f, 80.0f), {16, 32, 54, 32}, {-1.1f, -3.5f, -6, -10});
  config.noise_depth = infinity;
  config.noise_slope = 0;
  config.min_points = 10;
  config.sparse_bins_are_ground = false;
  config.seed_count = 20;
  config.seed_height = 0.5f;
  config.keep_below_margin = false;
  config.distance_margin = 0.15f;
  config.noise_margin = infinity;
  config.lower_plane_margin = infinity;
  config.iterations = 3;
  config.evaluate_final_set = true;
  config.uprightness = {.enabled = true, .angle = 45};
  config.elevation = {
      .enabled = true, .base = 0.366f, .growth = 0.0703f, .range = 22.025f, .scale = 1};
  config.flatness = {
      .enabled = true, .gain = 1.2f, .thresholds = {0.00012f, 0.00012f, 0.0002f}, .scale = 1};
  return config;
}

/// Rings of the authors' public code as of 2023. The radii are where groups of lasers of the
/// HDL-64E (24, 12, 4, 3, 2, 2, 2, 2, 2, 1, 1, 1, 1 and 1 lasers, 0.4 degrees apart, starting at
/// -24.8 degrees) meet flat ground 1.723 m below the sensor.
std::vector<Zone> laser_zones() {
  return make_zones({{6.430f, 9.576f},
                     {11.393f, 13.266f, 14.891f, 16.963f},
                     {19.694f, 23.463f, 29.001f, 32.877f},
                     {37.943f, 44.851f, 54.827f, 70.501f, 80.0f}},
                    {16, 32, 56, 32}, {-1.1f, -infinity, -infinity, -infinity});
}

PatchworkConfig reference() {
  PatchworkConfig config;
  config.sensor_height = 1.723f;
  config.zones = laser_zones();
  config.noise_depth = 2;
  config.noise_slope = 0;
  config.min_points = 11;
  config.sparse_bins_are_ground = true;
  config.seed_count = 20;
  config.seed_height = 0.5f;
  config.keep_below_margin = true;
  config.distance_margin = 0.125f;
  config.noise_margin = infinity;
  config.lower_plane_margin = infinity;
  config.iterations = 3;
  config.evaluate_final_set = false;
  config.uprightness = {.enabled = true, .angle = 45};
  config.elevation = {
      .enabled = true, .base = 0.333f, .growth = 0.0987f, .range = 13.266f, .scale = 1};
  config.flatness = {
      .enabled = true, .gain = 1.2f, .thresholds = {0.0005f, 0.000725f, 0.001f}, .scale = 1e-7f};
  return config;
}

constexpr std::array<std::string_view, 3> names = {"default", "paper", "reference"};

}  // namespace

std::vector<Zone> PatchworkConfig::default_zones() { return laser_zones(); }

PatchworkConfig PatchworkConfig::preset(std::string_view name) {
  if (name == "default") return {};
  if (name == "paper") return paper();
  if (name == "reference") return reference();
  throw std::invalid_argument("patchwork: " + no_such("preset", name, names));
}

std::span<const std::string_view> PatchworkConfig::preset_names() noexcept { return names; }

}  // namespace flagstone
