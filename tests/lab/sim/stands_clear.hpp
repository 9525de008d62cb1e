// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "lab/sim/geometry.hpp"
#include "lab/sim/ray_caster.hpp"

namespace flagstone::sim {

/// Whether nothing is within `aside` metres of the sensor, or `above` metres above it. Casts beams
/// in all directions, along a spiral from pole to pole.
inline bool stands_clear(const RayCaster& world, const Frame& pose, double aside, double above) {
  constexpr int beams = 400;
  for (int i = 0; i < beams; ++i) {
    const double up = -1 + (2.0 * i + 1) / beams;
    const double across = std::sqrt(1 - up * up);
    const Vector3 beam{across * std::cos(2.4 * i), across * std::sin(2.4 * i), up};
    const double reach = up > 0 ? std::min(aside, above / up) : aside;
    if (world.cast(pose.origin, pose.direction_to_world(beam), 0, reach)) return false;
  }
  return true;
}

}  // namespace flagstone::sim
