// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/truck.hpp"

#include <array>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface glass{.semantic = SemanticClass::truck, .reflectivity = 0.06F};
constexpr Surface rubber{.semantic = SemanticClass::truck, .reflectivity = 0.08F};
constexpr Surface steel{.semantic = SemanticClass::truck, .reflectivity = 0.2F};
constexpr double front = truck_length / 2;
constexpr double cab_rear = front - 2.2;
constexpr double trailer_front = front - 2.6;
constexpr double half = truck_width / 2;

void add_cab(Mesh& mesh, const Frame& frame, double roof, Surface paint) {
  constexpr double windscreen = 1.9;
  add_box(mesh, frame, {.low = {cab_rear, -half, 0.5}, .high = {front, half, windscreen}}, paint);
  // A box of glass, and the roof and the rear wall around it.
  add_box(mesh, frame,
          {.low = {cab_rear + 0.8, -half + 0.03, windscreen},
           .high = {front - 0.1, half - 0.03, windscreen + 0.9}},
          glass);
  add_box(mesh, frame, {.low = {cab_rear, -half, windscreen}, .high = {cab_rear + 0.8, half, roof}},
          paint);
  add_loft(mesh, frame,
           std::array{Section{.x = cab_rear + 0.8,
                              .low = windscreen + 0.9,
                              .high = roof,
                              .half_width_low = half,
                              .half_width_high = half - 0.1},
                      Section{.x = front - 0.1,
                              .low = windscreen + 0.9,
                              .high = windscreen + 1.1,
                              .half_width_low = half,
                              .half_width_high = half - 0.1}},
           paint);
}

void add_trailer(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface load{.semantic = SemanticClass::truck,
                     .reflectivity = static_cast<float>(random.uniform(0.15, 0.55))};
  constexpr double bed = 1.15;
  add_box(mesh, frame, {.low = {-front, -0.5, 0.8}, .high = {trailer_front, 0.5, bed}}, steel);
  const double drawn = random.uniform();
  if (drawn < 0.6) {
    add_box(mesh, frame, {.low = {-front, -half, bed}, .high = {trailer_front, half, 3.9}}, load);
  } else if (drawn < 0.8) {
    add_cone(mesh, frame,
             {.from = {-front, 0, bed + 1.15},
              .to = {trailer_front, 0, bed + 1.15},
              .radius_from = 1.15,
              .radius_to = 1.15,
              .sides = 16},
             load);
  } else {
    add_box(mesh, frame, {.low = {-front, -half, bed - 0.1}, .high = {trailer_front, half, bed}},
            steel);
    const double end = random.uniform(0, trailer_front - 1);
    add_box(
        mesh, frame,
        {.low = {-front + 1, -half + 0.2, bed}, .high = {end, half - 0.2, random.uniform(1.8, 3)}},
        load);
  }
}

void add_wheels(Mesh& mesh, const Frame& frame) {
  constexpr double radius = 0.5;
  for (const double axle : {front - 1.3, front - 4.6, -front + 2, -front + 3.3, -front + 4.6}) {
    for (const double side : {-1.0, 1.0}) {
      add_cone(mesh, frame,
               {.from = {axle, side * (half - 0.5), radius},
                .to = {axle, side * half, radius},
                .radius_from = radius,
                .radius_to = radius,
                .sides = 14},
               rubber);
    }
  }
}

}  // namespace

void add_truck(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface paint{.semantic = SemanticClass::truck,
                      .reflectivity = static_cast<float>(random.uniform(0.08, 0.5))};
  add_cab(mesh, frame, random.uniform(3, 3.8), paint);
  add_box(mesh, frame, {.low = {front - 5.6, -0.45, 0.6}, .high = {cab_rear, 0.45, 0.95}}, steel);
  add_trailer(mesh, frame, random);
  add_wheels(mesh, frame);
}

}  // namespace flagstone::sim
