// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "flagstone/baselines/cascaded.hpp"

namespace flagstone::baselines {

/// The beams of a spinning sensor and the radii of their rings on the ground. Tangents of angles
/// are computed once, so that points are compared by multiplication only.
class Beams {
 public:
  explicit Beams(const CascadedConfig& config);

  [[nodiscard]] std::size_t count() const noexcept { return slope_radii_.size(); }

  /// The beam with the elevation nearest to the elevation of a point at `height` above the sensor
  /// and at horizontal distance `range`, metres.
  [[nodiscard]] std::uint16_t nearest(float range, float height) const noexcept;

  /// Minimum horizontal distance of two rings on ground with a slope of at most max_slope, metres.
  /// Infinite if the upper beam does not hit such ground.
  [[nodiscard]] float least_distance(std::size_t lower, std::size_t upper) const noexcept;

  /// Radius of a ring on flat ground, metres. Infinite if the beam does not hit it.
  [[nodiscard]] float flat_radius(std::size_t ring) const noexcept { return flat_radii_[ring]; }

 private:
  std::vector<float> between_;  ///< tangent of the angle halfway from beam i to beam i + 1
  std::vector<float>
      slope_radii_;  ///< radius of each ring on ground that rises by max_slope, metres
  std::vector<float> flat_radii_;  ///< radius of each ring on flat ground, metres
};

}  // namespace flagstone::baselines
