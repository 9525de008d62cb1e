// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/person.hpp"

#include <array>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {

void add_person(Mesh& mesh, const Frame& frame, Random& random) {
  const double tall = random.uniform(1.55, 1.9);
  const double stride = random.uniform(0.05, 0.3);
  const Surface cloth{.semantic = SemanticClass::person,
                      .reflectivity = static_cast<float>(random.uniform(0.15, 0.5))};
  const double hip = 0.5 * tall;
  const double shoulder = 0.83 * tall;
  for (const double side : {-1.0, 1.0}) {
    add_cone(mesh, frame,
             {.from = {side * stride, side * 0.1, 0},
              .to = {0, side * 0.1, hip},
              .radius_from = 0.06,
              .radius_to = 0.09,
              .sides = 8},
             cloth);
    add_cone(mesh, frame,
             {.from = {-side * stride, side * 0.27, hip},
              .to = {0, side * 0.22, shoulder},
              .radius_from = 0.04,
              .radius_to = 0.06,
              .sides = 8},
             cloth);
  }
  // Lofts run along x: the trunk is thin from chest to back and broad from side to side.
  const auto trunk_at = [&](double x, double narrower) {
    return Section{.x = x,
                   .low = 0.95 * hip,
                   .high = shoulder,
                   .half_width_low = 0.16 - narrower,
                   .half_width_high = 0.22 - narrower};
  };
  add_loft(mesh, frame, std::array{trunk_at(-0.12, 0.06), trunk_at(0, 0), trunk_at(0.12, 0.06)},
           cloth);
  add_cone(mesh, frame,
           {.from = {0, 0, shoulder},
            .to = {0, 0, tall},
            .radius_from = 0.09,
            .radius_to = 0.08,
            .sides = 8},
           cloth);
}

}  // namespace flagstone::sim
