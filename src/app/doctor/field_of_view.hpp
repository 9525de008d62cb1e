// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "app/doctor/beam_rings.hpp"

namespace flagstone::doctor {

/// What a sensor looks at, as far as points came back.
struct FieldOfView {
  int beams = 0;             ///< 0: not known
  double top = 0;            ///< degrees above the horizontal
  double bottom = 0;         ///< the same
  double azimuth_begin = 0;  ///< degrees counter-clockwise from x, -180 to 180
  double azimuth_width = 0;  ///< degrees, 360 all around

  [[nodiscard]] bool sees_all_around() const noexcept { return azimuth_width >= 360; }
};

/// `places`: metres, the sensor in the origin, z is the axis it turns about. Points nearer than
/// `nearest`, metres, are left out: they lie on the vehicle.
FieldOfView find_field_of_view(std::span<const Vector3f> places, const BeamRings& rings,
                               double nearest);

}  // namespace flagstone::doctor
