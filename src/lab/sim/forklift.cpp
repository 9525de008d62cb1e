// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/forklift.hpp"

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface steel{.semantic = SemanticClass::other_vehicle, .reflectivity = 0.2F};
constexpr Surface driver{.semantic = SemanticClass::person, .reflectivity = 0.3F};
constexpr double rear = -forklift_length / 2;
constexpr double half = forklift_width / 2;
constexpr double mast = 0.55;  // behind it stands the body, before it the fork

void add_wheels(Mesh& mesh, const Frame& frame) {
  for (const double axle : {rear + 0.4, mast - 0.3}) {
    constexpr double radius = 0.28;
    for (const double side : {-1.0, 1.0}) {
      add_cone(mesh, frame,
               {.from = {axle, side * (half - 0.22), radius},
                .to = {axle, side * half, radius},
                .radius_from = radius,
                .radius_to = radius},
               steel);
    }
  }
}

}  // namespace

void add_forklift(Mesh& mesh, const Frame& frame, Random& random) {
  const Surface paint{.semantic = SemanticClass::other_vehicle,
                      .reflectivity = static_cast<float>(random.uniform(0.3, 0.6))};
  add_box(mesh, frame, {.low = {rear, -half + 0.05, 0.15}, .high = {mast - 0.1, half - 0.05, 0.7}},
          paint);
  add_box(mesh, frame, {.low = {rear, -half + 0.05, 0.7}, .high = {rear + 0.6, half - 0.05, 1.1}},
          paint);
  add_box(mesh, frame, {.low = {-0.8, -0.22, 0.7}, .high = {-0.5, 0.22, 1.55}}, driver);
  add_box(mesh, frame, {.low = {-0.75, -0.1, 1.55}, .high = {-0.55, 0.1, 1.8}}, driver);
  for (const double side : {-1.0, 1.0}) {
    const double y = side * (half - 0.15);
    add_box(mesh, frame, {.low = {mast - 0.1, y - 0.06, 0.05}, .high = {mast, y + 0.06, 2.2}},
            steel);
    add_box(mesh, frame, {.low = {rear + 0.5, y - 0.03, 1.1}, .high = {rear + 0.56, y + 0.03, 2.1}},
            steel);
    add_box(mesh, frame,
            {.low = {mast, side * 0.3 - 0.06, 0.08}, .high = {-rear, side * 0.3 + 0.06, 0.12}},
            steel);
  }
  add_box(mesh, frame, {.low = {rear + 0.4, -half + 0.1, 2.1}, .high = {mast, half - 0.1, 2.14}},
          steel);
  add_wheels(mesh, frame);
  if (random.chance(0.6)) {
    const Surface load{.semantic = SemanticClass::other_object,
                       .reflectivity = static_cast<float>(random.uniform(0.3, 0.6))};
    add_box(mesh, frame,
            {.low = {mast + 0.05, -half, 0.12}, .high = {-rear, half, random.uniform(0.8, 1.6)}},
            load);
  }
}

}  // namespace flagstone::sim
