// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>

#include "flagstone/patchwork_config.hpp"

namespace flagstone {

inline bool is_same(const Zone& a, const Zone& b) {
  return a.ring_radii == b.ring_radii && a.sectors == b.sectors &&
         a.height_margin == b.height_margin;
}

/// True if all settings are equal, bit for bit except for the sign of zero.
inline bool is_same(const PatchworkConfig& a, const PatchworkConfig& b) {
  const auto plain = [](const PatchworkConfig& c) {
    return std::tie(c.sensor_height, c.min_range, c.noise_depth, c.noise_slope, c.min_points,
                    c.sparse_bins_are_ground, c.seed_count, c.seed_height, c.keep_below_margin,
                    c.distance_margin, c.noise_margin, c.iterations, c.evaluate_final_set,
                    c.field_of_view.begin, c.field_of_view.width);
  };
  const auto terms = [](const PatchworkConfig& c) {
    return std::tie(c.uprightness.enabled, c.uprightness.angle, c.elevation.enabled,
                    c.elevation.base, c.elevation.growth, c.elevation.range, c.elevation.scale,
                    c.flatness.enabled, c.flatness.gain, c.flatness.thresholds, c.flatness.scale);
  };
  return plain(a) == plain(b) && terms(a) == terms(b) &&
         std::ranges::equal(a.zones, b.zones,
                            [](const Zone& x, const Zone& y) { return is_same(x, y); });
}

}  // namespace flagstone
