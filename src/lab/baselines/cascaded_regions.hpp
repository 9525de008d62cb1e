// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "lab/baselines/cascaded_beams.hpp"
#include "lab/baselines/fitted_plane.hpp"
#include "lab/baselines/usable_points.hpp"
#include "library/core/buffer.hpp"

namespace flagstone::baselines {

/// The regions of the second stage, and the points of a scan sorted by region. A region is a range
/// interval (section) within one of four directions, each 90 degrees wide.
class Regions {
 public:
  static constexpr std::size_t directions = 4;

  /// Value for points that belong to no region.
  static constexpr std::uint32_t no_region = ~0U;

  Regions(const Beams& beams, const CascadedConfig& config);

  [[nodiscard]] std::size_t sections() const noexcept { return outer_radii_.size(); }
  [[nodiscard]] std::size_t count() const noexcept { return sections() * directions; }
  [[nodiscard]] std::uint32_t region(std::size_t section, std::size_t direction) const noexcept {
    return static_cast<std::uint32_t>(section * directions + direction);
  }

  /// Region of a point at horizontal distance `range`, metres. Directions are numbered by azimuth
  /// from -x: 0 backward, 1 right, 2 forward, 3 left.
  [[nodiscard]] std::uint32_t region_of(float x, float y, float range) const noexcept;

  /// Inner radius of a section, metres.
  [[nodiscard]] float inner_radius(std::size_t section) const noexcept {
    return section == 0 ? 0 : outer_radii_[section - 1];
  }

  /// Reserves memory for `points` points; may throw std::bad_alloc.
  void reserve(std::size_t points);

  /// Sorts the points by region. `regions` contains the region of each point, or no_region.
  void sort(const UsablePoints& points, std::span<const std::uint32_t> regions) noexcept;

  /// The points of a region, in input order.
  [[nodiscard]] Coordinates points(std::uint32_t region) const noexcept;
  /// Index in the cloud of each point of a region.
  [[nodiscard]] std::span<const std::uint32_t> index(std::uint32_t region) const noexcept;

 private:
  [[nodiscard]] std::size_t size(std::uint32_t region) const noexcept {
    return begins_[region + 1] - begins_[region];
  }

  std::vector<float>
      outer_radii_;  ///< outer radius of each section, ascending; the last is infinite
  std::vector<std::size_t> begins_;  ///< index of the first point of each region, and the end
  std::vector<std::size_t> next_;    ///< index for the next point of each region
  Buffer<float> x_, y_, z_;
  Buffer<std::uint32_t> index_;
};

}  // namespace flagstone::baselines
