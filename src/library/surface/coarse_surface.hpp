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
  float slope_x, slope_y;  ///< m/m
};

/// Merges accepted patches into a surface on a grid. Near a patch, its plane has a weight that
/// increases with its quality and decreases with distance. Gaps between patches are filled relative
/// to a trend plane through all patches, so that slopes continue into unmeasured areas.
class CoarseSurface {
 public:
  /// Writes to the cells of `grid`. The ground below the sensor is expected at height
  /// `-sensor_height`.
  CoarseSurface(Grid grid, float sensor_height) noexcept
      : grid_(grid), expected_height_(-sensor_height) {}

  /// Removes all patches.
  void clear() noexcept;

  /// Adds a plane, in the sensor frame, that was fitted to a square patch of side `size`, metres.
  void add(const Plane& plane, float size) noexcept;

  /// Computes the surface from the added planes.
  void finish(PullPush& pull_push) noexcept;

 private:
  /// The least-squares plane through the means of the patches.
  [[nodiscard]] Trend trend() const noexcept;

  Grid grid_;              ///< before finish(): sums of weighted heights, and sums of weights
  float expected_height_;  ///< expected height of the ground below the sensor, metres

  /// Weighted sums over the means of the patches, for the trend.
  struct WeightedSums {
    double weight = 0;
    double x = 0, y = 0, z = 0;
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

    void add(const Vector3& mean, double mean_weight) noexcept;
  };
  WeightedSums means_;
};

}  // namespace flagstone::surface
