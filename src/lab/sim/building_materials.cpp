// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/building_materials.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface brick{.semantic = SemanticClass::other_object, .reflectivity = 0.35F};
constexpr Surface wood{.semantic = SemanticClass::other_object, .reflectivity = 0.4F};
constexpr Surface pipe_wall{.semantic = SemanticClass::other_object, .reflectivity = 0.3F};
constexpr Surface sheet_metal{.semantic = SemanticClass::other_structure, .reflectivity = 0.3F};
constexpr Surface concrete{.semantic = SemanticClass::fence, .reflectivity = 0.4F};
constexpr Surface wire{.semantic = SemanticClass::fence, .reflectivity = 0.4F};

}  // namespace

void add_heap(Mesh& mesh, const Ground& ground, const Heap& heap, Random& random) {
  constexpr std::size_t sectors = 24;
  constexpr std::size_t rings = 6;
  constexpr double buried = 0.2;  // of its rim, metres
  const Surface loose{.semantic = SemanticClass::other_object,
                      .reflectivity = static_cast<float>(random.uniform(0.22, 0.45))};
  const double steepness = std::tan(random.uniform(33, 38) * std::numbers::pi / 180);
  const double middle = ground.height(heap.x, heap.y);
  const double top = middle + 0.93 * steepness * heap.radius;
  std::vector<std::array<Vector3, sectors>> shells;
  for (std::size_t ring = 1; ring <= rings; ++ring) {
    const double out = static_cast<double>(ring) / rings;
    std::array<Vector3, sectors> shell;
    for (std::size_t sector = 0; sector < sectors; ++sector) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(sector) / sectors;
      const double r = out * heap.radius * random.uniform(0.94, 1.06);
      const double x = heap.x + heap.stretch * r * std::cos(angle);
      const double y = heap.y + r * std::sin(angle);
      const double rim = ground.height(x, y) - buried;
      shell[sector] = {x, y, rim + (1 - out) * (top - middle + buried)};
    }
    shells.push_back(shell);
  }
  const Vector3 peak{heap.x, heap.y, top - 0.06 * heap.radius};  // no heap ends in a point
  for (std::size_t sector = 0; sector < sectors; ++sector) {
    const std::size_t next = (sector + 1) % sectors;
    mesh.add_triangle(peak, shells[0][sector], shells[0][next], loose);
    for (std::size_t ring = 0; ring + 1 < rings; ++ring) {
      mesh.add_quad(shells[ring][sector], shells[ring][next], shells[ring + 1][next],
                    shells[ring + 1][sector], loose);
    }
  }
}

void add_pipe_stack(Mesh& mesh, const Frame& frame, double length, Random& random) {
  const double radius = random.uniform(0.15, 0.35);
  const int lowest = 3 + static_cast<int>(random.uniform(0, 3));
  const int rows = 2 + static_cast<int>(random.uniform(0, 2));
  for (int row = 0; row < rows; ++row) {
    const int count = lowest - row;
    for (int i = 0; i < count; ++i) {
      const double y = 2 * radius * (i - (count - 1) / 2.0);
      const double z = radius * (1 + std::numbers::sqrt3 * row);
      const double aside = random.uniform(-0.15, 0.15);
      add_cone(mesh, frame,
               {.from = {aside - length / 2, y, z},
                .to = {aside + length / 2, y, z},
                .radius_from = radius,
                .radius_to = radius,
                .sides = 12},
               pipe_wall);
    }
  }
}

void add_brick_pallet(Mesh& mesh, const Frame& frame, Random& random) {
  for (const double board : {-0.5, -0.06, 0.38}) {
    add_box(mesh, frame, {.low = {-0.6, board, 0}, .high = {0.6, board + 0.12, 0.1}}, wood);
  }
  add_box(mesh, frame, {.low = {-0.6, -0.5, 0.1}, .high = {0.6, 0.5, 0.14}}, wood);
  const double stacked = random.uniform(-0.3, 1.2);
  if (stacked < 0.1) return;
  add_box(mesh, frame, {.low = {-0.5, -0.45, 0.14}, .high = {0.5, 0.45, 0.14 + stacked}}, brick);
}

void add_board(Mesh& mesh, const Frame& frame, Random& random) {
  const double half_length = random.uniform(1, 2.5);
  const double half_width = random.uniform(0.1, 0.25);
  constexpr double above = 0.01;  // of its lower side, metres
  add_box(
      mesh, frame,
      {.low = {-half_length, -half_width, above}, .high = {half_length, half_width, above + 0.04}},
      wood);
}

void add_container(Mesh& mesh, const Frame& frame) {
  add_box(mesh, frame, {.low = {-3, -1.2, -0.1}, .high = {3, 1.2, 2.6}}, sheet_metal);
}

void add_mesh_panel(Mesh& mesh, const Frame& frame) {
  constexpr double half_width = 1.7;
  constexpr double height = 2;
  constexpr double tube = 0.02;
  const auto bar = [&](double x0, double x1, double z0, double z1) {
    mesh.add_quad(frame.to_world({x0, 0, z0}), frame.to_world({x1, 0, z0}),
                  frame.to_world({x1, 0, z1}), frame.to_world({x0, 0, z1}), wire);
  };
  for (const double x : {-half_width, half_width}) {
    add_box(mesh, frame, {.low = {x - tube, -tube, 0}, .high = {x + tube, tube, height}}, wire);
    add_box(mesh, frame, {.low = {x - 0.1, -0.35, 0}, .high = {x + 0.1, 0.35, 0.13}}, concrete);
  }
  bar(-half_width, half_width, 0.12, 0.16);
  bar(-half_width, half_width, height - 0.04, height);
  for (double x = -half_width + 0.12; x < half_width; x += 0.12) bar(x, x + 0.01, 0.14, height);
  for (double z = 0.35; z < height; z += 0.25) bar(-half_width, half_width, z, z + 0.01);
}

}  // namespace flagstone::sim
