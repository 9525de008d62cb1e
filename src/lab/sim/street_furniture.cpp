// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/street_furniture.hpp"

#include <cmath>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::pole, .reflectivity = 0.25F};
constexpr Surface retroreflector{.semantic = SemanticClass::traffic_sign, .reflectivity = 0.9F};
constexpr Surface wood{.semantic = SemanticClass::fence, .reflectivity = 0.4F};
constexpr double buried = 0.1;  // metres

}  // namespace

void add_lamp_post(Mesh& mesh, const Frame& frame) {
  constexpr double height = 6;
  add_cone(mesh, frame,
           {.from = {0, 0, -buried}, .to = {0, 0, height}, .radius_from = 0.09, .radius_to = 0.05},
           steel);
  add_box(mesh, frame, {.low = {0, -0.05, height}, .high = {1.4, 0.05, height + 0.1}}, steel);
}

void add_traffic_sign(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -buried}, .to = {0, 0, 2.9}, .radius_from = 0.035, .radius_to = 0.035},
           steel);
  add_box(mesh, frame, {.low = {0.04, -0.33, 2.2}, .high = {0.06, 0.33, 2.86}}, retroreflector);
}

void add_delineator(Mesh& mesh, const Frame& frame) {
  constexpr Surface plastic{.semantic = SemanticClass::pole, .reflectivity = 0.6F};
  add_box(mesh, frame, {.low = {-0.04, -0.06, -buried}, .high = {0.04, 0.06, 1}}, plastic);
}

void add_fence(Mesh& mesh, const Ground& ground, const Fence& fence) {
  constexpr double pitch = 0.15;  // of boards 0.1 m wide
  const double along = std::hypot(fence.x1 - fence.x0, fence.y1 - fence.y0);
  const double yaw = std::atan2(fence.y1 - fence.y0, fence.x1 - fence.x0);
  const int boards = static_cast<int>(along / pitch);
  for (int board = 0; board < boards; ++board) {
    const double share = (board + 0.5) / boards;
    const double x = fence.x0 + share * (fence.x1 - fence.x0);
    const double y = fence.y0 + share * (fence.y1 - fence.y0);
    const Frame frame = upright_frame({x, y, ground.height(x, y)}, yaw);
    add_box(mesh, frame, {.low = {-0.05, 0, -buried}, .high = {0.05, 0.02, fence.height}}, wood);
    for (const double rail : {0.3, 0.85}) {
      add_box(mesh, frame,
              {.low = {-pitch / 2, 0.02, rail}, .high = {pitch / 2, 0.05, rail + 0.08}}, wood);
    }
  }
}

}  // namespace flagstone::sim
