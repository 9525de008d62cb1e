// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork_config.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace flagstone {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

[[noreturn]] void refuse(const std::string& field, double value, const std::string& allowed) {
  std::ostringstream message;
  message << "patchwork: " << field << " = " << value << " is out of range; allowed: " << allowed;
  throw std::invalid_argument(message.str());
}

void check_between(const std::string& field, double value, double low, double high,
                   const std::string& unit) {
  if (value >= low && value <= high) return;  // false for NaN
  std::ostringstream allowed;
  allowed << low << " to " << high << unit;
  refuse(field, value, allowed.str());
}

void check_above(const std::string& field, double value, double low, double high,
                 const std::string& unit) {
  if (value > low && value <= high) return;
  std::ostringstream allowed;
  allowed << "above " << low << ", up to " << high << unit;
  refuse(field, value, allowed.str());
}

/// Checks one zone that begins at `inner` metres; returns where it ends.
float check_zone(const Zone& zone, const std::string& name, float inner) {
  check_between("length of " + name + ".ring_radii", static_cast<double>(zone.ring_radii.size()), 1,
                1000, " rings");
  for (std::size_t i = 0; i < zone.ring_radii.size(); ++i) {
    check_above(name + ".ring_radii[" + std::to_string(i) + "]", zone.ring_radii[i], inner, 1000,
                " m (radii ascend outward, from min_range on)");
    inner = zone.ring_radii[i];
  }
  check_between(name + ".sectors", zone.sectors, 1, 3600, "");
  if (!(zone.height_margin < -1.0f)) {
    refuse(name + ".height_margin", zone.height_margin, "below -1 (minus infinity for no margin)");
  }
  return inner;
}

void check_zones(const PatchworkConfig& config) {
  check_between("min_range", config.min_range, 0, 1000, " m");
  check_between("number of zones", static_cast<double>(config.zones.size()), 1, 16, "");
  float inner = config.min_range;
  std::size_t bins = 0;
  for (std::size_t m = 0; m < config.zones.size(); ++m) {
    const Zone& zone = config.zones[m];
    inner = check_zone(zone, "zones[" + std::to_string(m) + "]", inner);
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }
  check_between("number of bins (rings times sectors over all zones)", static_cast<double>(bins), 1,
                65535, "");
}

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
  config.few_points_are_ground = false;
  config.seed_count = 20;
  config.seed_height = 0.5f;
  config.keep_below_margin = false;
  config.distance_margin = 0.15f;
  config.noise_margin = infinity;
  config.iterations = 3;
  config.judge_final_set = true;
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
  config.few_points_are_ground = true;
  config.seed_count = 20;
  config.seed_height = 0.5f;
  config.keep_below_margin = true;
  config.distance_margin = 0.125f;
  config.noise_margin = infinity;
  config.iterations = 3;
  config.judge_final_set = false;
  config.uprightness = {.enabled = true, .angle = 45};
  config.elevation = {
      .enabled = true, .base = 0.333f, .growth = 0.0987f, .range = 13.266f, .scale = 1};
  config.flatness = {
      .enabled = true, .gain = 1.2f, .thresholds = {0.0005f, 0.000725f, 0.001f}, .scale = 1e-7f};
  return config;
}

constexpr std::array<std::string_view, 3> names = {"default", "paper", "reference"};

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

std::vector<Zone> PatchworkConfig::default_zones() { return laser_zones(); }

PatchworkConfig PatchworkConfig::preset(std::string_view name) {
  if (name == "default") return {};
  if (name == "paper") return paper();
  if (name == "reference") return reference();
  throw std::invalid_argument("patchwork: no preset is named \"" + std::string(name) +
                              "\"; there are default, paper and reference");
}

std::span<const std::string_view> PatchworkConfig::preset_names() noexcept { return names; }

void PatchworkConfig::check() const {
  check_between("sensor_height", sensor_height, -100, 100, " m");
  check_zones(*this);
  if (noise_depth != infinity) {
    check_between("noise_depth", noise_depth, 0, 1000, " m, or infinity for none");
  }
  check_between("noise_slope", noise_slope, 0, 10, " m/m");
  check_between("min_points", min_points, 3, 1000000, "");
  check_between("seed_count", seed_count, 1, 1000, "");
  check_above("seed_height", seed_height, 0, 100, " m");
  check_above("distance_margin", distance_margin, 0, 100, " m");
  if (noise_margin != infinity) {
    check_above("noise_margin", noise_margin, 0, 1000, " m, or infinity for none");
  }
  check_between("iterations", iterations, 1, 100, "");
  check_between("uprightness.angle", uprightness.angle, 0, 90, " degrees");
  check_between("elevation.base", elevation.base, 0, 100, " m");
  check_between("elevation.growth", elevation.growth, 0, 1, " per m");
  check_between("elevation.range", elevation.range, 0, 1000, " m");
  check_above("elevation.scale", elevation.scale, 0, 1000, " m");
  check_above("flatness.gain", flatness.gain, 1, 1000, "");
  check_between("length of flatness.thresholds", static_cast<double>(flatness.thresholds.size()), 1,
                1000, "");
  for (std::size_t i = 0; i < flatness.thresholds.size(); ++i) {
    check_between("flatness.thresholds[" + std::to_string(i) + "]", flatness.thresholds[i], 0,
                  1.0 / 3, "");
  }
  check_above("flatness.scale", flatness.scale, 0, 1000, "");
}

}  // namespace flagstone
