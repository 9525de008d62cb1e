// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/goods.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "lab/sim/mesh.hpp"

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
  constexpr double buried = 0.2;  // depth of its rim below the ground, metres
  const Surface loose = random_shade(SemanticClass::other_object, {0.22, 0.45}, random);
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
  const Vector3 peak{heap.x, heap.y, top - 0.06 * heap.radius};  // heaps have a blunt top
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
  constexpr double above = 0.01;  // height of its lower side, metres
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

namespace {

constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.3F};
constexpr Surface pallet_truck{.semantic = SemanticClass::other_object, .reflectivity = 0.35F};

Surface draw_load(Random& random) {
  return random_shade(SemanticClass::other_object, {0.2, 0.65}, random);
}

}  // namespace

void add_pallet(Mesh& mesh, const Frame& frame, double load, Random& random) {
  constexpr double deck = 0.1;  // height of its lower side
  for (const double y : {-0.4, -0.07, 0.26}) {
    add_box(mesh, frame, {.low = {-0.6, y, 0}, .high = {0.6, y + 0.14, deck}}, wood);
  }
  add_box(mesh, frame, {.low = {-0.6, -0.4, deck}, .high = {0.6, 0.4, pallet_height}}, wood);
  if (load == 0) return;
  const double in = random.uniform(0, 0.06);
  add_box(mesh, frame,
          {.low = {-0.6 + in, -0.4 + in, pallet_height},
           .high = {0.6 - in, 0.4 - in, pallet_height + load}},
          draw_load(random));
}

void add_rack(Mesh& mesh, const Frame& frame, const Rack& rack, Random& random) {
  constexpr double half = rack_depth / 2;
  constexpr double post = 0.1;
  const double level_height = random.uniform(1.4, 1.9);
  const double top = rack.levels * level_height + 0.6;
  for (int i = 0; i <= rack.bays; ++i) {
    const double x = i * rack_bay;
    for (const double y : {-half, half - post}) {
      add_box(mesh, frame, {.low = {x - post / 2, y, 0}, .high = {x + post / 2, y + post, top}},
              steel);
    }
  }
  constexpr int pallets = 3;
  constexpr double pitch = (rack_bay - post) / pallets;
  for (int bay = 0; bay < rack.bays; ++bay) {
    const double begin = bay * rack_bay + post / 2;
    for (int level = 0; level <= rack.levels; ++level) {
      const double z = level * level_height;
      if (level > 0) {
        for (const double y : {-half, half - 0.05}) {
          add_box(mesh, frame,
                  {.low = {begin, y, z - 0.12}, .high = {begin + rack_bay - post, y + 0.05, z}},
                  steel);
        }
      }
      for (int place = 0; place < pallets; ++place) {
        if (!random.chance(0.75)) continue;
        const double x = begin + (place + 0.5) * pitch;
        const double load = random.uniform(0.3, level_height - 0.4);
        if (level == 0) {
          // Turned, so that its long side points into the rack.
          const Frame turned{.origin = frame.to_world({x, 0, 0}),
                             .forward = frame.left,
                             .left = -1 * frame.forward,
                             .up = frame.up};
          add_pallet(mesh, turned, load, random);
        } else {
          add_box(mesh, frame,
                  {.low = {x - 0.4, -half, z}, .high = {x + 0.4, half, z + pallet_height}}, wood);
          add_box(mesh, frame,
                  {.low = {x - 0.38, -half, z + pallet_height},
                   .high = {x + 0.38, half, z + pallet_height + load}},
                  draw_load(random));
        }
      }
    }
  }
}

void add_pallet_truck(Mesh& mesh, const Frame& frame) {
  for (const double y : {-0.26, 0.1}) {
    add_box(mesh, frame, {.low = {-0.4, y, 0.05}, .high = {0.75, y + 0.16, 0.11}}, pallet_truck);
  }
  add_box(mesh, frame, {.low = {-0.6, -0.2, 0.03}, .high = {-0.4, 0.2, 0.5}}, pallet_truck);
  add_cone(mesh, frame,
           {.from = {-0.55, 0, 0.45},
            .to = {-0.75, 0, 1.2},
            .radius_from = 0.03,
            .radius_to = 0.03,
            .sides = 6},
           pallet_truck);
}

}  // namespace flagstone::sim
