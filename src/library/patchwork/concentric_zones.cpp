// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/concentric_zones.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "library/plane_fits/scan_points.hpp"

namespace flagstone::patchwork {

static_assert(most_bins + 3 < 1U << plane_fits::bin_bits);  // noise and the like included

namespace {

float squared(float radius) {
  return static_cast<float>(static_cast<double>(radius) * static_cast<double>(radius));
}

}  // namespace

ConcentricZones::ConcentricZones(const PatchworkConfig& config) {
  const double begin = config.field_of_view.begin / 360.0 + 0.5;
  begin_turn_ = static_cast<float>(begin - std::floor(begin));
  if (begin_turn_ == 1) begin_turn_ = 0;
  turns_ = config.field_of_view.width / 360;
  squared_radii_.push_back(squared(config.min_range));
  for (std::size_t zone = 0; zone < config.zones.size(); ++zone) {
    for (std::size_t ring = 0; ring < config.zones[zone].ring_radii.size(); ++ring) {
      add_ring(config, zone, ring);
    }
  }
  least_squared_range_ = std::max(squared_radii_.front(), std::numeric_limits<float>::min());
  // Where rho^2 is infinite the tree leads to its last leaf, ring or not.
  const std::size_t table_size = std::max(std::bit_ceil(rings_.size()), RingTree::few);
  for (std::vector<float>* table : {&sectors_, &first_bins_, &noise_heights_}) {
    table->resize(table_size);
  }
  grow_tree();
}

void ConcentricZones::add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring) {
  const float inner = std::sqrt(squared_radii_.back());
  const float outer = config.zones[zone].ring_radii[ring];
  const int sectors = config.zones[zone].sectors;
  rings_.push_back({.zone = static_cast<std::uint16_t>(zone),
                    .ring = static_cast<std::uint16_t>(ring),
                    .sectors = static_cast<std::uint16_t>(sectors),
                    .first_bin = bin_count_,
                    .center_radius = (inner + outer) / 2});
  sectors_.push_back(static_cast<float>(sectors));
  first_bins_.push_back(std::bit_cast<float>(bin_count_));
  noise_heights_.push_back(-config.sensor_height - config.noise_depth - config.noise_slope * outer);
  bin_count_ += static_cast<std::uint32_t>(sectors);
  squared_radii_.push_back(squared(outer));
}

void ConcentricZones::grow_tree() {
  const std::size_t leaves = std::max(std::bit_ceil(rings_.size()), RingTree::few);
  for (std::size_t width = leaves; width > 1; width /= 2) {
    std::vector<float>& level = tree_.boundaries.emplace_back();
    for (std::size_t begin = 0; begin < leaves; begin += width) {
      const std::size_t ring = begin + width / 2;  // the first one of the right half
      level.push_back(ring < rings_.size() ? squared_radii_[ring]
                                           : std::numeric_limits<float>::infinity());
    }
    level.resize(std::max<std::size_t>(level.size(), 16));
  }
}

}  // namespace flagstone::patchwork
