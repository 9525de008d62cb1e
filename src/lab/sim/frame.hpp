// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/sim/vector3.hpp"

namespace flagstone::sim {

class Ground;

/// Where something stands and how it is turned: the pose of a sensor or of an object in the world.
/// The axes are of unit length and at right angles: x forward, y left, z up.
struct Frame {
  Vector3 origin;
  Vector3 forward{1, 0, 0};
  Vector3 left{0, 1, 0};
  Vector3 up{0, 0, 1};

  /// A direction of this frame in world coordinates.
  [[nodiscard]] Vector3 direction_to_world(Vector3 local) const noexcept {
    return local.x * forward + local.y * left + local.z * up;
  }
  /// A point of this frame in world coordinates.
  [[nodiscard]] Vector3 to_world(Vector3 local) const noexcept {
    return origin + direction_to_world(local);
  }
  /// A world point in coordinates of this frame.
  [[nodiscard]] Vector3 to_local(Vector3 world) const noexcept {
    const Vector3 from_origin = world - origin;
    return {dot(from_origin, forward), dot(from_origin, left), dot(from_origin, up)};
  }
};

/// Upright at this place: turned by `yaw` (radians, counter-clockwise from world x), z vertical.
Frame upright_frame(Vector3 origin, double yaw);

/// Standing on the ground at (x, y) as a car stands on its wheels: tilted like the ground between
/// points `length` metres apart along and `width` metres across, origin on the ground.
Frame frame_on_wheels(const Ground& ground, double x, double y, double yaw, double length,
                      double width);

/// The same frame moved by `distance` metres along its own z axis.
Frame raised(Frame frame, double distance);

}  // namespace flagstone::sim
