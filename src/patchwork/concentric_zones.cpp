// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "patchwork/concentric_zones.hpp"

#include <numbers>

namespace flagstone::patchwork {
namespace {

float squared(float radius) {
  return static_cast<float>(static_cast<double>(radius) * static_cast<double>(radius));
}

}  // namespace

ConcentricZones::ConcentricZones(const PatchworkConfig& config) {
  squared_radii_.push_back(squared(config.min_range));
  for (std::size_t zone = 0; zone < config.zones.size(); ++zone) {
    const auto first_heading = static_cast<std::uint32_t>(headings_.size());
    add_headings(config.zones[zone].sectors);
    for (std::size_t ring = 0; ring < config.zones[zone].ring_radii.size(); ++ring) {
      add_ring(config, zone, ring, first_heading);
    }
  }
  fill_ring_table();
}

void ConcentricZones::add_ring(const PatchworkConfig& config, std::size_t zone, std::size_t ring,
                               std::uint32_t first_heading) {
  const float inner = std::sqrt(squared_radii_.back());
  const float outer = config.zones[zone].ring_radii[ring];
  const int sectors = config.zones[zone].sectors;
  rings_.push_back(
      {.zone = static_cast<std::uint16_t>(zone),
       .ring = static_cast<std::uint16_t>(ring),
       .sectors = static_cast<std::uint16_t>(sectors),
       .first_bin = bin_count_,
       .first_heading = first_heading,
       .noise_height = -config.sensor_height - config.noise_depth - config.noise_slope * outer,
       .center_radius = (inner + outer) / 2});
  bin_count_ += static_cast<std::uint32_t>(sectors);
  squared_radii_.push_back(squared(outer));
}

void ConcentricZones::add_headings(int sectors) {
  for (int j = 0; j <= sectors; ++j) {
    const double theta = 2 * std::numbers::pi * j / sectors - std::numbers::pi;  // eq. (2)
    // Boundaries on an axis are on it exactly, and so are the points that lie there.
    const auto exact = [](double v) { return std::abs(v) < 1e-15 ? 0.0f : static_cast<float>(v); };
    headings_.push_back({exact(std::cos(theta)), exact(std::sin(theta))});
  }
}

void ConcentricZones::fill_ring_table() {
  first_cell_ = std::bit_cast<std::uint32_t>(squared_radii_.front()) >> cell_shift;
  const std::uint32_t last_cell = std::bit_cast<std::uint32_t>(squared_radii_.back()) >> cell_shift;
  std::uint16_t ring = 0;
  for (std::uint32_t cell = first_cell_; cell <= last_cell; ++cell) {
    const auto cell_begin = std::bit_cast<float>(cell << cell_shift);
    while (ring + 1u < rings_.size() && cell_begin >= squared_radii_[ring + 1u]) ++ring;
    ring_table_.push_back(ring);
  }
}

}  // namespace flagstone::patchwork
