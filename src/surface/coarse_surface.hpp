// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "core/plane.hpp"
#include "surface/grid.hpp"
#include "surface/pull_push.hpp"

namespace flagstone::surface {

/// Joins accepted patches to a surface on a grid: near a patch its plane counts, the more the
/// closer and the better it fits; between patches what lies around.
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
  Grid grid_;  ///< until finish(): sums of weighted heights, and of weights
  float foot_;
};

}  // namespace flagstone::surface
