// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "flagstone/patch.hpp"
#include "flagstone/patchwork_config.hpp"
#include "library/core/plane.hpp"
#include "library/patchwork/concentric_zones.hpp"

namespace flagstone::patchwork {

/// Ground Likelihood Estimation, section III-D, eqs. (7) to (12): decides whether a fitted patch is
/// ground. The likelihood of a scan, eq. (7), is a product over its patches, so each patch is
/// evaluated separately.
class GroundLikelihood {
 public:
  GroundLikelihood(const PatchworkConfig& config, const std::vector<Ring>& rings);

  /// Sets the terms and the status of the patch. `plane` must exist; `ring` counts over all zones.
  void judge(const Plane& plane, std::size_t ring, Patch& patch) const noexcept;

 private:
  [[nodiscard]] double uprightness(const Plane& plane) const noexcept;
  [[nodiscard]] double elevation(const Plane& plane, std::size_t ring) const noexcept;
  [[nodiscard]] double flatness(double elevation, double sigma, std::size_t ring) const noexcept;

  struct RingLimits {
    bool near;        ///< r_n < L_tau
    double midpoint;  ///< kappa(r_n), metres
    double flat;      ///< sigma_tau of this ring
  };

  UprightnessTerm uprightness_;
  double smallest_normal_z_;  ///< cos(pi/2 - theta_tau)
  double elevation_scale_;
  FlatnessTerm flatness_;
  std::vector<RingLimits> rings_;
};

}  // namespace flagstone::patchwork
