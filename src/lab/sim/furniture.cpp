// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/furniture.hpp"

#include <array>
#include <cmath>

#include "lab/sim/mesh.hpp"

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
  constexpr double pitch = 0.15;  // metres; boards are 0.1 m wide
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

namespace {

constexpr Surface town_steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.25F};
constexpr Surface pane{
    .semantic = SemanticClass::other_structure, .reflectivity = 0.06F, .mirror = 0.8F};
constexpr Surface town_wood{.semantic = SemanticClass::other_object, .reflectivity = 0.4F};
constexpr Surface bin{.semantic = SemanticClass::other_object, .reflectivity = 0.2F};
constexpr Surface grey_post{.semantic = SemanticClass::pole, .reflectivity = 0.3F};
constexpr double town_buried = 0.15;  // metres

}  // namespace

void add_bus_shelter(Mesh& mesh, const Frame& frame) {
  constexpr double half = 2;
  constexpr double deep = 1.4;
  constexpr double height = 2.4;
  for (const double y : {-half, half - 0.08}) {
    for (const double x : {-deep, -0.4}) {
      add_box(mesh, frame, {.low = {x, y, -town_buried}, .high = {x + 0.08, y + 0.08, height}},
              town_steel);
    }
    const double middle = y + 0.04;
    mesh.add_quad(frame.to_world({-deep, middle, 0.2}), frame.to_world({-0.4, middle, 0.2}),
                  frame.to_world({-0.4, middle, 2.1}), frame.to_world({-deep, middle, 2.1}), pane);
  }
  mesh.add_quad(frame.to_world({-deep, -half, 0.2}), frame.to_world({-deep, half, 0.2}),
                frame.to_world({-deep, half, 2.1}), frame.to_world({-deep, -half, 2.1}), pane);
  add_box(mesh, frame,
          {.low = {-deep - 0.1, -half - 0.1, height}, .high = {0, half + 0.1, height + 0.12}},
          town_steel);
  add_box(mesh, frame, {.low = {-deep + 0.1, -1, 0.42}, .high = {-deep + 0.5, 1, 0.47}}, town_wood);
  for (const double y : {-0.9, 0.85}) {
    add_box(mesh, frame,
            {.low = {-deep + 0.25, y, -town_buried}, .high = {-deep + 0.35, y + 0.05, 0.42}},
            town_wood);
  }
}

void add_bench(Mesh& mesh, const Frame& frame) {
  add_box(mesh, frame, {.low = {-0.25, -0.8, 0.4}, .high = {0.2, 0.8, 0.46}}, town_wood);
  add_box(mesh, frame, {.low = {-0.3, -0.8, 0.46}, .high = {-0.25, 0.8, 0.85}}, town_wood);
  for (const double y : {-0.7, 0.6}) {
    add_box(mesh, frame, {.low = {-0.25, y, -town_buried}, .high = {0.2, y + 0.1, 0.4}}, town_wood);
  }
}

void add_bin(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -town_buried}, .to = {0, 0, 0.9}, .radius_from = 0.2, .radius_to = 0.25},
           bin);
}

void add_bollard(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -town_buried},
            .to = {0, 0, 0.9},
            .radius_from = 0.06,
            .radius_to = 0.06,
            .sides = 8},
           grey_post);
}

void add_traffic_light(Mesh& mesh, const Frame& frame, double arm) {
  constexpr double high = 5.9;
  const double top = arm == 0 ? 3.4 : high;
  add_cone(
      mesh, frame,
      {.from = {0, 0, -town_buried}, .to = {0, 0, top}, .radius_from = 0.08, .radius_to = 0.06},
      grey_post);
  const auto head = [&](double y, double bottom) {
    add_box(mesh, frame, {.low = {0.08, y - 0.16, bottom}, .high = {0.3, y + 0.16, bottom + 0.95}},
            grey_post);
  };
  head(0, 2.3);
  if (arm == 0) return;
  add_box(mesh, frame, {.low = {-0.05, 0, high - 0.12}, .high = {0.05, arm, high}}, grey_post);
  head(arm, high - 1);
}

namespace {

constexpr Surface rail{.semantic = SemanticClass::fence, .reflectivity = 0.35F};
constexpr Surface concrete{.semantic = SemanticClass::fence, .reflectivity = 0.38F};
constexpr Surface panel{.semantic = SemanticClass::fence, .reflectivity = 0.3F};
constexpr double piece = 4;  // length of a straight piece, metres
constexpr double barrier_buried = 0.2;

}  // namespace

void add_guard_rail(Mesh& mesh, double t, Interval x, const RoadPlace& place) {
  add_beam(mesh, {.t = {t - 0.04, t + 0.04}, .z = {0.45, 0.76}}, x, piece, place, rail);
  for (double post = x.low; post <= x.high; post += piece) {
    add_beam(mesh, {.t = {t - 0.03, t + 0.03}, .z = {-barrier_buried, 0.7}},
             {post - 0.06, post + 0.06}, piece, place, rail);
  }
}

void add_concrete_barrier(Mesh& mesh, double t, Interval x, const RoadPlace& place) {
  add_extrusion(mesh,
                std::array{OutlinePoint{t - 0.3, -barrier_buried},
                           OutlinePoint{t + 0.3, -barrier_buried}, OutlinePoint{t + 0.3, 0.08},
                           OutlinePoint{t + 0.1, 0.9}, OutlinePoint{t - 0.1, 0.9},
                           OutlinePoint{t - 0.3, 0.08}, OutlinePoint{t - 0.3, -barrier_buried}},
                x, piece, place, concrete);
}

void add_noise_barrier(Mesh& mesh, double t, double height, Interval x, const RoadPlace& place) {
  constexpr double pitch = 5;
  add_beam(mesh, {.t = {t - 0.06, t + 0.06}, .z = {-barrier_buried, height}}, x, pitch, place,
           panel);
  for (double post = x.low; post <= x.high; post += pitch) {
    add_beam(mesh, {.t = {t - 0.12, t + 0.12}, .z = {-barrier_buried, height + 0.05}},
             {post - 0.1, post + 0.1}, pitch, place, concrete);
  }
}

}  // namespace flagstone::sim
