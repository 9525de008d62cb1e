// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/park_furniture.hpp"

#include "sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface wood{.semantic = SemanticClass::other_object, .reflectivity = 0.35F};
constexpr Surface iron{.semantic = SemanticClass::other_object, .reflectivity = 0.15F};
constexpr double buried = 0.1;  // metres

}  // namespace

void add_bench(Mesh& mesh, const Frame& frame) {
  constexpr double half_width = 0.9;
  constexpr double seat = 0.45;
  for (const double slat : {-0.2, -0.06, 0.08}) {
    add_box(mesh, frame,
            {.low = {slat, -half_width, seat}, .high = {slat + 0.11, half_width, seat + 0.03}},
            wood);
  }
  for (const double slat : {0.58, 0.74}) {
    add_box(mesh, frame,
            {.low = {-0.26, -half_width, slat}, .high = {-0.23, half_width, slat + 0.11}}, wood);
  }
  for (const double side : {-0.75, 0.7}) {
    add_box(mesh, frame, {.low = {-0.28, side, -buried}, .high = {-0.22, side + 0.05, 0.85}}, iron);
    add_box(mesh, frame, {.low = {0.14, side, -buried}, .high = {0.19, side + 0.05, seat}}, iron);
  }
}

void add_litter_bin(Mesh& mesh, const Frame& frame) {
  add_cone(mesh, frame,
           {.from = {0, 0, -buried}, .to = {0, 0, 0.35}, .radius_from = 0.04, .radius_to = 0.04},
           iron);
  add_cone(mesh, frame,
           {.from = {0, 0, 0.35}, .to = {0, 0, 0.9}, .radius_from = 0.2, .radius_to = 0.22}, iron);
}

}  // namespace flagstone::sim
