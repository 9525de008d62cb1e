// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/patch.hpp"
#include "flagstone/surface_config.hpp"
#include "library/core/plane.hpp"
#include "library/surface/accepted_patches.hpp"
#include "library/surface/slab_counts.hpp"

namespace flagstone::surface {

/// Says which patches are ground.
class PatchJudge {
 public:
  explicit PatchJudge(const SurfaceConfig& config);

  /// By itself: enough points, upright, with more points in its plane than above it, not too high.
  /// The plane is in the sensor frame.
  [[nodiscard]] Verdict judge_alone(const Plane& plane, const SlabCounts& counts) const noexcept;

  /// By those nearer to the sensor: close to where they let expect ground, or, where there are
  /// none, to the sensor's height. `ground`, or `off_surface`.
  [[nodiscard]] Verdict judge_step(const FittedPatch& patch,
                                   const AcceptedPatches& nearer) const noexcept;

 private:
  double least_normal_z_;
  double max_clutter_ratio_;
  double sensor_height_;
  double height_;
  double rise_;
  float step_;
  float step_growth_;
};

}  // namespace flagstone::surface
