// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "app/doctor/beam_rings.hpp"

namespace flagstone::doctor {

/// Where along z the beams come from, as far as their points tell. All points of a beam have one
/// elevation, if seen from where it comes from.
struct BeamOrigin {
  double height = 0;            ///< z of that place, metres
  double spread = 0;            ///< median deviation of a beam's elevations from there, degrees
  double spread_at_origin = 0;  ///< the same from the cloud's origin

  /// Is that place elsewhere than the cloud's origin, without doubt?
  [[nodiscard]] bool is_elsewhere() const noexcept;
};

/// `places`: metres, z is the axis the sensor turns about, above a ground at z = `ground`. The
/// rings must be known.
BeamOrigin find_beam_origin(std::span<const Vector3f> places, const BeamRings& rings,
                            double ground);

}  // namespace flagstone::doctor
