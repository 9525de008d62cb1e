// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/cascaded_regions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flagstone::baselines {
namespace {

/// Outer radii of sections with the same number of rings each; the last section has the remaining
/// rings. A section is as wide as its rings on flat ground, so denser points give smaller regions.
std::vector<float> section_radii(const Beams& beams, std::size_t sections) {
  const std::size_t rings_per_section = (beams.count() + sections - 1) / sections;
  std::vector<float> radii;
  for (std::size_t end = rings_per_section; end < beams.count(); end += rings_per_section) {
    radii.push_back(beams.flat_radius(end - 1));
  }
  radii.push_back(std::numeric_limits<float>::infinity());
  return radii;
}

}  // namespace

Regions::Regions(const Beams& beams, const CascadedConfig& config)
    : outer_radii_(section_radii(beams, static_cast<std::size_t>(config.sections))),
      begins_(count() + 1),
      next_(count()) {}

std::uint32_t Regions::region_of(float x, float y, float range) const noexcept {
  std::size_t section = 0;
  while (section + 1 < sections() && range >= outer_radii_[section]) ++section;
  const bool along_x = std::abs(x) >= std::abs(y);
  const std::size_t direction = along_x ? (x > 0 ? 2 : 0) : (y > 0 ? 3 : 1);
  return region(section, direction);
}

void Regions::reserve(std::size_t points) {
  x_.reserve(points);
  y_.reserve(points);
  z_.reserve(points);
  index_.reserve(points);
}

void Regions::sort(const UsablePoints& points, std::span<const std::uint32_t> regions) noexcept {
  std::ranges::fill(begins_, 0);
  for (const std::uint32_t region : regions) {
    if (region != no_region) ++begins_[region + 1];
  }
  for (std::size_t region = 0; region < count(); ++region) {
    begins_[region + 1] += begins_[region];
    next_[region] = begins_[region];
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (regions[k] == no_region) continue;
    const std::size_t to = next_[regions[k]]++;
    x_.data()[to] = points.x()[k];
    y_.data()[to] = points.y()[k];
    z_.data()[to] = points.z()[k];
    index_.data()[to] = points.index()[k];
  }
}

Coordinates Regions::points(std::uint32_t region) const noexcept {
  const std::size_t begin = begins_[region];
  const std::size_t n = size(region);
  return {{x_.data() + begin, n}, {y_.data() + begin, n}, {z_.data() + begin, n}};
}

std::span<const std::uint32_t> Regions::index(std::uint32_t region) const noexcept {
  return {index_.data() + begins_[region], size(region)};
}

}  // namespace flagstone::baselines
