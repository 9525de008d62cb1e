// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/guard_rail.hpp"

#include <cmath>

#include "sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::fence, .reflectivity = 0.35F};
constexpr Surface plastic{.semantic = SemanticClass::pole, .reflectivity = 0.6F};
constexpr double buried = 0.3;  // metres

}  // namespace

void add_guard_rail(Mesh& mesh, const Ground& ground, const GuardRail& rail) {
  constexpr double piece = 2;  // between posts, metres
  const double along = std::hypot(rail.x1 - rail.x0, rail.y1 - rail.y0);
  const int pieces = static_cast<int>(std::ceil(along / piece));
  const auto post = [&](int number) {
    const double share = static_cast<double>(number) / pieces;
    const double x = rail.x0 + share * (rail.x1 - rail.x0);
    const double y = rail.y0 + share * (rail.y1 - rail.y0);
    return Vector3{x, y, ground.height(x, y)};
  };
  const double yaw = std::atan2(rail.y1 - rail.y0, rail.x1 - rail.x0);
  for (int i = 0; i <= pieces; ++i) {
    add_box(mesh, upright_frame(post(i), yaw),
            {.low = {-0.05, -0.03, -buried}, .high = {0.05, 0.03, 0.7}}, steel);
    if (i == pieces) break;
    // Along the line between the feet of two posts.
    const Vector3 from = post(i);
    const Vector3 to = post(i + 1);
    Frame frame;
    frame.origin = from;
    frame.forward = normalized(to - from);
    frame.left = {-std::sin(yaw), std::cos(yaw), 0};
    frame.up = cross(frame.forward, frame.left);
    add_box(mesh, frame, {.low = {0, -0.06, 0.45}, .high = {length(to - from), 0.06, 0.75}}, steel);
  }
}

void add_delineator(Mesh& mesh, const Ground& ground, double x, double y) {
  add_box(mesh, upright_frame({x, y, ground.height(x, y)}, 0),
          {.low = {-0.04, -0.06, -buried}, .high = {0.04, 0.06, 1}}, plastic);
}

}  // namespace flagstone::sim
