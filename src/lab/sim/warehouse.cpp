// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/warehouse.hpp"

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface wood{.semantic = SemanticClass::other_object, .reflectivity = 0.4F};
constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.3F};
constexpr Surface truck{.semantic = SemanticClass::other_object, .reflectivity = 0.35F};

Surface draw_load(Random& random) {
  return {.semantic = SemanticClass::other_object,
          .reflectivity = static_cast<float>(random.uniform(0.2, 0.65))};
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
          // Turned: its long side goes into the rack.
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
    add_box(mesh, frame, {.low = {-0.4, y, 0.05}, .high = {0.75, y + 0.16, 0.11}}, truck);
  }
  add_box(mesh, frame, {.low = {-0.6, -0.2, 0.03}, .high = {-0.4, 0.2, 0.5}}, truck);
  add_cone(mesh, frame,
           {.from = {-0.55, 0, 0.45},
            .to = {-0.75, 0, 1.2},
            .radius_from = 0.03,
            .radius_to = 0.03,
            .sides = 6},
           truck);
}

}  // namespace flagstone::sim
