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

/// Checks one zone that begins at `inner` metres; returns where it ends.
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
                  .remark = "radii ascend outward, from min_range on"});
    inner = zone.ring_radii[i];
  }
  check_number(method, name + ".sectors", zone.sectors, {.low = 1, .high = 3600});
  if (!(zone.height_margin < -1.0f)) {
    throw_out_of_range(method, name + ".height_margin", zone.height_margin,
                       "below -1 (minus infinity for no margin)");
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
    const double share = static_cast<double>(i) / count;
    radii.push_back(static_cast<float>(inner + share * (static_cast<double>(outer) - inner)));
  }
  return radii;
}

std::vector<Setting> settings_of(PatchworkConfig& c) {
  return {
      {"sensor_height",
       &c.sensor_height,
       "h_s: sensor above ground",
       {.low = -100, .high = 100, .unit = "m"}},
      {"min_range",
       &c.min_range,
       "L_min: nearer points are out of range",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"noise_depth",
       &c.noise_depth,
       "points lower than -h_s - noise_depth - noise_slope * r are noise",
       {.low = 0, .high = 1000, .unit = "m", .allow_infinity = true}},
      {"noise_slope",
       &c.noise_slope,
       "steepest descent of ground still believed",
       {.low = 0, .high = 10, .unit = "m/m"}},
      {"min_points",
       &c.min_points,
       "bins with fewer points are not fitted",
       {.low = 3, .high = 1000000}},
      {"sparse_bins_are_ground", &c.sparse_bins_are_ground, "what the points of such bins are"},
      {"seed_count",
       &c.seed_count,
       "N_seed: lowest points that start the fit",
       {.low = 1, .high = 1000}},
      {"seed_height",
       &c.seed_height,
       "z_seed, eq. (5)",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"keep_below_margin", &c.keep_below_margin,
       "whether points below a zone's height margin may enter the first ground set"},
      {"distance_margin",
       &c.distance_margin,
       "M_d, eq. (6)",
       {.low = 0, .high = 100, .unit = "m", .exclusive_min = true}},
      {"noise_margin",
       &c.noise_margin,
       "points farther below the plane are no part of it but noise",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true, .allow_infinity = true}},
      {"lower_plane_margin",
       &c.lower_plane_margin,
       "points farther below a ground plane are ground in a plane of their own, else noise",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true, .allow_infinity = true}},
      {"iterations", &c.iterations, "plane fits a bin", {.low = 1, .high = 100}},
      {"evaluate_final_set", &c.evaluate_final_set,
       "whether the likelihood judges the final ground set (paper) or the last fitted one (public "
       "code)"},
      {"field_of_view.begin",
       &c.field_of_view.begin,
       "where sector 0 begins, counter-clockwise from x",
       {.low = -360, .high = 360, .unit = "degrees"}},
      {"field_of_view.width",
       &c.field_of_view.width,
       "how far the zones go from there; points outside are out of range",
       {.low = 0, .high = 360, .unit = "degrees", .exclusive_min = true}},
      {"uprightness.enabled", &c.uprightness.enabled, "phi, eq. (9)"},
      {"uprightness.angle",
       &c.uprightness.angle,
       "theta_tau: smallest angle between normal and x-y plane",
       {.low = 0, .high = 90, .unit = "degrees"}},
      {"elevation.enabled", &c.elevation.enabled, "psi, eq. (10)"},
      {"elevation.base",
       &c.elevation.base,
       "kappa(r) = -h_s + base * exp(growth * r)",
       {.low = 0, .high = 100, .unit = "m"}},
      {"elevation.growth", &c.elevation.growth, "of kappa", {.low = 0, .high = 1, .unit = "per m"}},
      {"elevation.range",
       &c.elevation.range,
       "L_tau: bins centred beyond are not judged by elevation",
       {.low = 0, .high = 1000, .unit = "m"}},
      {"elevation.scale",
       &c.elevation.scale,
       "width of the step; 1 is the paper's formula",
       {.low = 0, .high = 1000, .unit = "m", .exclusive_min = true}},
      {"flatness.enabled", &c.flatness.enabled, "varphi, eq. (11)"},
      {"flatness.gain", &c.flatness.gain, "zeta", {.low = 1, .high = 1000, .exclusive_min = true}},
      {"flatness.thresholds",
       &c.flatness.thresholds,
       "sigma_tau of each ring, the last one for all beyond",
       {.low = 0, .high = 1.0 / 3}},
      {"flatness.scale",
       &c.flatness.scale,
       "width of the step, units of sigma; 1 is the paper's formula",
       {.low = 0, .high = 1000, .exclusive_min = true}},
  };
}

void PatchworkConfig::check() const {
  PatchworkConfig copy = *this;  // settings point into something that may be written to
  check_settings(method, settings_of(copy));
  check_zones(*this);
}

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Zones with the sector counts and height margins given, one set of ring radii each.
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

/// Rings 2, 4, 4, 4 between the boundaries that section III-B derives from L_min and L_max.
std::vector<std::vector<float>> paper_rings(float l_min, float l_max) {
  const float l_2 = (7 * l_min + l_max) / 8;
  const float l_3 = (3 * l_min + l_max) / 4;
  const float l_4 = (l_min + l_max) / 2;
  return {equal_rings(l_min, l_2, 2), equal_rings(l_2, l_3, 4), equal_rings(l_3, l_4, 4),
          equal_rings(l_4, l_max, 4)};
}

/// Section IV-C. The paper prints neither M_h beyond Z_1, nor kappa, nor zeta: M_h loosens so that
/// ground falling away by 20 % is kept, kappa goes through the elevation steps of the authors' code
/// at the ring centres, zeta is ours.
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

/// Rings of the public code as of 2023: radii where groups of the HDL-64E's lasers (24, 12, 4, 3,
/// 2, 2, 2, 2, 2, 1, 1, 1, 1, 1 of them, 0.4 degrees apart from -24.8 degrees on) meet flat
/// ground 1.723 m below.
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
