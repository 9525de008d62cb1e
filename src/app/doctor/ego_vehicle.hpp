// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// What lies around the sensor, where its own vehicle is.
struct OwnVehicle {
  double share = 0;  ///< of all points, those around the sensor that stand over the ground
  double roof = 0;   ///< height above the ground at which most of them lie, metres; 0: no roof seen
};

/// `places`: metres from the sensor, z up, above a ground at z = `ground`. Around the sensor is
/// nearer than `radius`, metres, seen from above.
OwnVehicle find_own_vehicle(std::span<const Vector3f> places, double ground, double radius);

}  // namespace flagstone::doctor
