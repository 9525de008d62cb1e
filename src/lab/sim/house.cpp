// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/house.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface tiles{.semantic = SemanticClass::building, .reflectivity = 0.3F};
constexpr Surface pane{.semantic = SemanticClass::building, .reflectivity = 0.05F};
constexpr Surface stone{.semantic = SemanticClass::building, .reflectivity = 0.35F};

// The front wall as piers and panels around windows that lie back by the depth of the wall.
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
  const Surface plaster{.semantic = SemanticClass::building,
                        .reflectivity = static_cast<float>(random.uniform(0.3, 0.6))};
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

}  // namespace flagstone::sim
