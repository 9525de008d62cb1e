// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "flagstone/patchwork_config.hpp"

namespace flagstone {
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
  throw std::invalid_argument("patchwork: no preset is named \"" + std::string(name) +
                              "\"; there are default, paper and reference");
}

std::span<const std::string_view> PatchworkConfig::preset_names() noexcept { return names; }

}  // namespace flagstone
