// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "flagstone/baselines/cascaded.hpp"
#include "flagstone/baselines/ransac.hpp"
#include "lab/baselines/fitted_plane.hpp"

namespace flagstone::baselines {

/// Planes of the second stage: one for each region of a direction, outward.
class ContinuousPlanes {
 public:
  explicit ContinuousPlanes(const CascadedConfig& config);

  /// The ground below the sensor, with which every direction begins.
  [[nodiscard]] Plane below_sensor() const noexcept;

  /// The plane of a region: by RANSAC from its points, or `previous`, that of the region before it,
  /// where there is none or it is not continuous with `previous`. The two regions meet at (x, y),
  /// metres. `region` numbers the draws, so that no region depends on another's.
  [[nodiscard]] Plane fit(const Coordinates& points, const Plane& previous, double x, double y,
                          std::size_t region) const noexcept;

  /// Whether a point lies on `plane`.
  [[nodiscard]] bool is_ground(const SinglePrecisionPlane& plane, float x, float y,
                               float z) const noexcept;

 private:
  [[nodiscard]] bool is_continuous(const Plane& plane, const Plane& previous, double x,
                                   double y) const noexcept;

  double sensor_height_;
  double min_cosine_;  ///< of the angle between one plane and the next
  double max_height_change_;
  RansacConfig search_;
};

}  // namespace flagstone::baselines
