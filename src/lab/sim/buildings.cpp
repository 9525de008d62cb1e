// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/buildings.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

namespace {

constexpr Surface tiles{.semantic = SemanticClass::building, .reflectivity = 0.3F};
constexpr Surface pane{.semantic = SemanticClass::building, .reflectivity = 0.05F};
constexpr Surface stone{.semantic = SemanticClass::building, .reflectivity = 0.35F};

// The front wall as piers and panels around windows that are recessed by the depth of the wall.
void add_front(Mesh& mesh, const Frame& frame, const House& house, Surface plaster) {
  constexpr double wall = 0.2;
  constexpr double storey = 2.7;
  constexpr double sill = 0.9;
  constexpr double window_height = 1.4;
  const int windows = std::max(2, static_cast<int>(house.width / 2.6));
  const int storeys = std::max(1, static_cast<int>(house.eaves / storey));
  const double pitch = house.width / windows;
  const auto panel = [&](double x_low, double x_high, double z_low, double z_high) {
    add_box(mesh, frame, {.low = {x_low, 0, z_low}, .high = {x_high, wall, z_high}}, plaster);
  };
  const double left = -house.width / 2;
  for (int i = 0; i < windows; ++i) {
    const double x = left + i * pitch;
    panel(x, x + 0.3 * pitch, -house.buried, house.eaves);
    panel(x + 0.7 * pitch, x + pitch, -house.buried, house.eaves);
    double top = -house.buried;
    for (int floor = 0; floor < storeys; ++floor) {
      const double window = 0.3 + floor * storey + sill;
      panel(x + 0.3 * pitch, x + 0.7 * pitch, top, window);
      top = window + window_height;
    }
    panel(x + 0.3 * pitch, x + 0.7 * pitch, top, house.eaves);
  }
  add_box(mesh, frame,
          {.low = {left, wall - 0.02, -house.buried}, .high = {-left, wall, house.eaves}}, pane);
}

void add_roof(Mesh& mesh, const Frame& frame, const House& house, double pitch) {
  constexpr double overhang = 0.4;
  const double ridge = house.eaves + pitch * house.depth / 2;
  const double low = house.eaves - pitch * overhang;
  const double x = house.width / 2 + overhang;
  for (const auto& [y_low, y_ridge] : {std::array{-overhang, house.depth / 2},
                                       std::array{house.depth + overhang, house.depth / 2}}) {
    mesh.add_quad(frame.to_world({-x, y_low, low}), frame.to_world({x, y_low, low}),
                  frame.to_world({x, y_ridge, ridge}), frame.to_world({-x, y_ridge, ridge}), tiles);
  }
}

void add_gables(Mesh& mesh, const Frame& frame, const House& house, double pitch, Surface plaster) {
  const double ridge = house.eaves + pitch * house.depth / 2;
  for (const double x : {-house.width / 2, house.width / 2}) {
    mesh.add_triangle(frame.to_world({x, 0, house.eaves}),
                      frame.to_world({x, house.depth, house.eaves}),
                      frame.to_world({x, house.depth / 2, ridge}), plaster);
  }
}

}  // namespace

void add_house(Mesh& mesh, const Frame& frame, const House& house, Random& random) {
  const Surface plaster = random_shade(SemanticClass::building, {0.3, 0.6}, random);
  constexpr double front = 0.2;
  add_front(mesh, frame, house, plaster);
  add_box(mesh, frame,
          {.low = {-house.width / 2, front, -house.buried},
           .high = {house.width / 2, house.depth, house.eaves}},
          plaster);
  const double pitch = random.uniform(0.5, 0.9);
  add_roof(mesh, frame, house, pitch);
  add_gables(mesh, frame, house, pitch, plaster);
  const double door = random.uniform(-0.3, 0.3) * house.width;
  add_box(mesh, frame, {.low = {door - 0.8, -1, -house.buried}, .high = {door + 0.8, 0, 0.3}},
          stone);
}

namespace {

constexpr Surface mirroring_pane{
    .semantic = SemanticClass::building, .reflectivity = 0.05F, .mirror = 0.5F};
constexpr Surface shop_glass{
    .semantic = SemanticClass::building, .reflectivity = 0.05F, .mirror = 0.9F};
constexpr Surface canvas{.semantic = SemanticClass::building, .reflectivity = 0.45F};
constexpr double town_buried = 2;
constexpr double ground_floor = 3.7;
constexpr double storey = 3;
constexpr double wall = 0.22;  // depth of the windows, metres

void add_shop(Mesh& mesh, const Frame& frame, double half, Surface plaster, Random& random) {
  const double plinth = random.uniform(0.25, 0.6);
  const double head = random.uniform(2.7, 3);
  constexpr double pier = 0.35;
  add_box(mesh, frame, {.low = {-half, 0, -town_buried}, .high = {half, 0.1, plinth}}, stone);
  add_box(mesh, frame, {.low = {-half, 0, head}, .high = {half, wall, ground_floor}}, plaster);
  for (const double x : {-half, half - pier}) {
    add_box(mesh, frame, {.low = {x, 0, -town_buried}, .high = {x + pier, wall, head}}, plaster);
  }
  mesh.add_quad(frame.to_world({-half, 0.06, plinth}), frame.to_world({half, 0.06, plinth}),
                frame.to_world({half, 0.06, head}), frame.to_world({-half, 0.06, head}),
                shop_glass);
  if (random.chance(0.3)) {
    const double reach = random.uniform(0.8, 1.3);
    mesh.add_quad(frame.to_world({-half + pier, 0, head + 0.1}),
                  frame.to_world({half - pier, 0, head + 0.1}),
                  frame.to_world({half - pier, -reach, head - 0.35}),
                  frame.to_world({-half + pier, -reach, head - 0.35}), canvas);
  }
}

// Bands between the rows of windows and piers between their columns, in front of a single pane.
void add_windows(Mesh& mesh, const Frame& frame, double half, double bottom, int storeys,
                 Surface plaster, Random& random) {
  constexpr double sill = 0.8;
  constexpr double window_height = 1.6;
  const int windows = std::max(2, static_cast<int>(2 * half / 2.3));
  const double pitch = 2 * half / windows;
  const double top = bottom + storeys * storey;
  double band = bottom;
  for (int floor = 0; floor < storeys; ++floor) {
    const double window = bottom + floor * storey + sill;
    add_box(mesh, frame, {.low = {-half, 0, band}, .high = {half, wall, window}}, plaster);
    band = window + window_height;
  }
  add_box(mesh, frame, {.low = {-half, 0, band}, .high = {half, wall, top}}, plaster);
  for (int i = 0; i <= windows; ++i) {
    const double x = -half + i * pitch;
    add_box(mesh, frame,
            {.low = {std::max(-half, x - 0.25 * pitch), 0, bottom},
             .high = {std::min(half, x + 0.25 * pitch), wall, top}},
            plaster);
  }
  mesh.add_quad(frame.to_world({-half, wall - 0.02, bottom}),
                frame.to_world({half, wall - 0.02, bottom}),
                frame.to_world({half, wall - 0.02, top}), frame.to_world({-half, wall - 0.02, top}),
                mirroring_pane);
  if (random.chance(0.25)) {
    const double x = -half + pitch * static_cast<int>(random.uniform(0, windows));
    for (int floor = 0; floor < storeys; ++floor) {
      const double level = bottom + floor * storey;
      add_box(mesh, frame, {.low = {x, -0.9, level}, .high = {x + pitch, 0, level + 0.15}}, stone);
      add_box(mesh, frame, {.low = {x, -0.9, level}, .high = {x + pitch, -0.85, level + 1}}, stone);
    }
  }
}

}  // namespace

double height_of(const TerraceHouse& house) noexcept {
  return ground_floor + house.storeys * storey + 0.4;
}

void add_terrace_house(Mesh& mesh, const Frame& frame, const TerraceHouse& house, Random& random) {
  const Surface plaster = random_shade(SemanticClass::building, {0.25, 0.6}, random);
  const double half = house.width / 2;
  if (house.shop) {
    add_shop(mesh, frame, half, plaster, random);
    add_windows(mesh, frame, half, ground_floor, house.storeys, plaster, random);
  } else {
    constexpr double raised = ground_floor - storey;  // level of the ground floor
    add_box(mesh, frame, {.low = {-half, 0, -town_buried}, .high = {half, wall, raised}}, stone);
    add_windows(mesh, frame, half, raised, house.storeys + 1, plaster, random);
    const double door = random.uniform(-0.3, 0.3) * house.width;
    for (const double step : {0.0, 0.3}) {
      add_box(mesh, frame,
              {.low = {door - 0.7, -0.6 + step, -town_buried},
               .high = {door + 0.7, 0, 0.16 + 0.5 * step}},
              stone);
    }
  }
  add_box(mesh, frame,
          {.low = {-half, wall, -town_buried}, .high = {half, house.depth, height_of(house)}},
          plaster);
}

}  // namespace flagstone::sim
