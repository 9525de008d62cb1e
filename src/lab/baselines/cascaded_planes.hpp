// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "lab/baselines/fitted_plane.hpp"

namespace flagstone::baselines {

/// Fits the planes of the second stage: one per region of a direction, from the sensor outward.
class ContinuousPlanes {
 public:
  explicit ContinuousPlanes(const CascadedConfig& config);

  /// The ground below the sensor, which is the first plane of every direction.
  [[nodiscard]] Plane below_sensor() const noexcept;

  /// Returns the RANSAC plane of a region, or `previous`, the plane of the previous region, if
  /// there is no plane or it is not continuous with `previous`. The two regions meet at (x, y),
  /// metres. `region` selects the random numbers, so that regions are independent of each other.
  [[nodiscard]] Plane fit(const Coordinates& points, const Plane& previous, double x, double y,
                          std::size_t region) const noexcept;

  /// Whether a point is within max_distance of `plane`.
  [[nodiscard]] bool is_ground(const SinglePrecisionPlane& plane, float x, float y,
                               float z) const noexcept;

 private:
  [[nodiscard]] bool is_continuous(const Plane& plane, const Plane& previous, double x,
                                   double y) const noexcept;

  double sensor_height_;
  double min_cosine_;  ///< cosine of the maximum angle between consecutive planes
  double max_height_change_;
  RansacConfig search_;
};

}  // namespace flagstone::baselines
