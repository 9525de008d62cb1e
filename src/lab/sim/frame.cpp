// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/frame.hpp"

#include <cmath>

#include "lab/sim/ground.hpp"

namespace flagstone::sim {

Frame upright_frame(Vector3 origin, double yaw) {
  return {.origin = origin,
          .forward = {std::cos(yaw), std::sin(yaw), 0},
          .left = {-std::sin(yaw), std::cos(yaw), 0},
          .up = {0, 0, 1}};
}

Frame frame_on_wheels(const Ground& ground, double x, double y, double yaw, double length,
                      double width) {
  const auto on_ground = [&](double ahead, double aside) {
    const double px = x + ahead * std::cos(yaw) - aside * std::sin(yaw);
    const double py = y + ahead * std::sin(yaw) + aside * std::cos(yaw);
    return Vector3{px, py, ground.height(px, py)};
  };
  Frame frame;
  frame.origin = on_ground(0, 0);
  frame.forward = normalized(on_ground(length / 2, 0) - on_ground(-length / 2, 0));
  const Vector3 across = on_ground(0, width / 2) - on_ground(0, -width / 2);
  frame.up = normalized(cross(frame.forward, across));
  frame.left = cross(frame.up, frame.forward);
  return frame;
}

Frame raised(Frame frame, double distance) {
  frame.origin = frame.origin + distance * frame.up;
  return frame;
}

}  // namespace flagstone::sim
