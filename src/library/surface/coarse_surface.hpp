// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "library/core/moments.hpp"
#include "library/core/plane.hpp"
#include "library/surface/grid.hpp"

namespace flagstone::surface {

/// A plane over the whole grid.
struct Trend {
  float height;            ///< at the sensor, metres
  float slope_x, slope_y;  ///< metres a metre
};

/// Joins accepted patches to a surface on a grid: near a patch its plane counts, the more the
/// closer and the better it fits; between patches what lies around, as seen from the plane that
/// follows all of them, so that a slope goes on where nothing was measured.
class CoarseSurface {
 public:
  /// On `grid`, whose cells it fills; foot: the ground below the sensor is expected at height
  /// `-sensor_height`.
  CoarseSurface(Grid grid, float sensor_height) noexcept : grid_(grid), foot_(-sensor_height) {}

  /// No patches.
  void clear() noexcept;

  /// Adds a plane, in the sensor frame, that was fitted to a square patch of side `size`, metres.
  void add(const Plane& plane, float size) noexcept;

  /// Makes the surface of what was added.
  void finish(PullPush& pull_push) noexcept;

 private:
  /// The plane of least squares through the patches' means.
  [[nodiscard]] Trend trend() const noexcept;

  Grid grid_;  ///< until finish(): sums of weighted heights, and of weights
  float foot_;

  /// Weighted sums over the patches' means, for the trend.
  struct WeightedSums {
    double weight = 0;
    double x = 0, y = 0, z = 0;
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

    void add(const Vector3& mean, double mean_weight) noexcept;
  };
  WeightedSums means_;
};

}  // namespace flagstone::surface
