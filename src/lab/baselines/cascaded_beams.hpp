// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/baselines/cascaded.hpp"

namespace flagstone::baselines {

/// The beams of a spinning sensor and the rings they draw on the ground. Angles become tangents
/// once, here; points are then compared by multiplication alone.
class Beams {
 public:
  explicit Beams(const CascadedConfig& config);

  [[nodiscard]] std::size_t count() const noexcept { return slope_radii_.size(); }

  /// The beam whose elevation is nearest to that of a point `height` above the sensor, at
  /// horizontal distance `range`; metres.
  [[nodiscard]] std::uint16_t nearest(float range, float height) const noexcept;

  /// How far apart, horizontally, two rings are at least, on ground no steeper than max_slope;
  /// metres, infinite if the upper beam does not meet such ground.
  [[nodiscard]] float least_distance(std::size_t lower, std::size_t upper) const noexcept;

  /// Radius of a ring on flat ground, metres, infinite if the beam does not meet it.
  [[nodiscard]] float flat_radius(std::size_t ring) const noexcept { return flat_radii_[ring]; }

 private:
  std::vector<float> between_;      ///< tangent of the angle halfway from beam i to beam i + 1
  std::vector<float> slope_radii_;  ///< of each ring on ground that rises by max_slope, metres
  std::vector<float> flat_radii_;
};

}  // namespace flagstone::baselines
