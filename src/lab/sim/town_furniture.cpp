// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/town_furniture.hpp"

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.25F};
constexpr Surface pane{
    .semantic = SemanticClass::other_structure, .reflectivity = 0.06F, .mirror = 0.8F};
constexpr Surface wood{.semantic = SemanticClass::other_object, .reflectivity = 0.4F};
constexpr Surface bin{.semantic = SemanticClass::other_object, .reflectivity = 0.2F};
constexpr Surface post{.semantic = SemanticClass::pole, .reflectivity = 0.3F};
constexpr double buried = 0.15;  // metres

}  // namespace

void add_bus_shelter(Mesh& mesh, const Frame& frame) {
  constexpr double half = 2;
  constexpr double deep = 1.4;
  constexpr double height = 2.4;
  for (const double y : {-half, half - 0.08}) {
    for (const double x : {-deep, -0.4}) {
      add_box(mesh, frame, {.low = {x, y, -buried}, .high = {x + 0.08, y + 0.08, height}}, steel);
    }
    const double middle = y + 0.04;
    mesh.add_quad(frame.to_world({-deep, middle, 0.2}), frame.to_world({-0.4, middle, 0.2}),
                  frame.to_world({-0.4, middle, 2.1}), frame.to_world({-deep, middle, 2.1}), pane);
  }
  mesh.add_quad(frame.to_world({-deep, -half, 0.2}), frame.to_world({-deep, half, 0.2}),
                frame.to_world({-deep, half, 2.1}), frame.to_world({-deep, -half, 2.1}), pane);
  add_box(mesh, frame,
          {.low = {-deep - 0.1, -half - 0.1, height}, .high = {0, half + 0.1, height + 0.12}},
          steel);
  add_box(mesh, frame, {.low = {-deep + 0.1, -1, 0.42}, .high = {-deep + 0.5, 1, 0.47}}, wood);
  for (const double y : {-0.9, 0.85}) {
    add_box(mesh, frame,
            {.low = {-deep + 0.25, y, -buried}, .high = {-deep + 0.35, y + 0.05, 0.42}}, wood);
  }
}

void add_bench(Mesh& mesh, const Frame& frame) {
  add_box(mesh, frame, {.low = {-0.25, -0.8, 0.4}, .high = {0.2, 0.8, 0.46}}, wood);
  add_box(mesh, frame, {.low = {-0.3, -0.8, 0.46}, .high = {-0.25, 0.8, 0.85}}, wood);
  for (const double y : {-0.7, 0.6}) {
    add_box(mesh, frame, {.low = {-0.25, y, -buried}, .high = {0.2, y + 0.1, 0.4}}, wood);
  }
}

void add_bin(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -buried}, .to = {0, 0, 0.9}, .radius_from = 0.2, .radius_to = 0.25},
           bin);
}

void add_bollard(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -buried},
            .to = {0, 0, 0.9},
            .radius_from = 0.06,
            .radius_to = 0.06,
            .sides = 8},
           post);
}

void add_traffic_light(Mesh& mesh, const Frame& frame, double arm) {
  constexpr double high = 5.9;
  const double top = arm == 0 ? 3.4 : high;
  add_cone(mesh, frame,
           {.from = {0, 0, -buried}, .to = {0, 0, top}, .radius_from = 0.08, .radius_to = 0.06},
           post);
  const auto head = [&](double y, double bottom) {
    add_box(mesh, frame, {.low = {0.08, y - 0.16, bottom}, .high = {0.3, y + 0.16, bottom + 0.95}},
            post);
  };
  head(0, 2.3);
  if (arm == 0) return;
  add_box(mesh, frame, {.low = {-0.05, 0, high - 0.12}, .high = {0.05, arm, high}}, post);
  head(arm, high - 1);
}

}  // namespace flagstone::sim
