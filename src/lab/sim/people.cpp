// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/people.hpp"

#include <array>

#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

void add_person(Mesh& mesh, const Frame& frame, Random& random) {
  const double tall = random.uniform(1.55, 1.9);
  const double stride = random.uniform(0.05, 0.3);
  const Surface cloth = random_shade(SemanticClass::person, {0.15, 0.5}, random);
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
  // Lofts are along x: the trunk is thin from chest to back and wide from side to side.
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

namespace {

struct Tube {
  Vector3 from, to;
  double radius_from, radius_to;
};

}  // namespace

void add_cyclist(Mesh& mesh, const Frame& frame, Random& random) {
  constexpr Surface bicycle{.semantic = SemanticClass::bicyclist, .reflectivity = 0.2F};
  const Surface cloth = random_shade(SemanticClass::bicyclist, {0.15, 0.5}, random);
  const auto add = [&](const Tube& tube, Surface surface, int sides) {
    add_cone(mesh, frame,
             {.from = tube.from,
              .to = tube.to,
              .radius_from = tube.radius_from,
              .radius_to = tube.radius_to,
              .sides = sides},
             surface);
  };
  constexpr double radius = 0.34;  // of the wheels, which are discs: few beams pass between spokes
  constexpr Vector3 saddle{-0.25, 0, 0.95};
  constexpr Vector3 handlebar{0.4, 0, 1.05};
  constexpr Vector3 pedals{-0.05, 0, 0.3};
  for (const double axle : {-0.52, 0.52}) {
    add({{axle, -0.02, radius}, {axle, 0.02, radius}, radius, radius}, bicycle, 16);
  }
  add({{-0.52, 0, radius}, saddle, 0.02, 0.02}, bicycle, 5);
  add({pedals, saddle, 0.02, 0.02}, bicycle, 5);
  add({pedals, handlebar, 0.02, 0.02}, bicycle, 5);
  add({{0.52, 0, radius}, handlebar, 0.02, 0.02}, bicycle, 5);
  add({handlebar + Vector3{0, -0.28, 0}, handlebar + Vector3{0, 0.28, 0}, 0.02, 0.02}, bicycle, 5);

  const double tall = random.uniform(0.9, 1.1);
  const Vector3 hip = saddle + Vector3{0, 0, 0.08};
  const Vector3 neck = hip + tall * Vector3{0.32, 0, 0.5};
  add({hip, neck, 0.17, 0.19}, cloth, 8);
  add({neck, neck + Vector3{0.05, 0, 0.3}, 0.1, 0.09}, cloth, 8);
  const double turned = random.uniform(-0.15, 0.15);  // of the pedals
  for (const double side : {-1.0, 1.0}) {
    const Vector3 knee = hip + Vector3{0.38, side * 0.12, -0.25 + side * turned};
    const Vector3 foot = pedals + Vector3{0, side * 0.1, side * turned};
    add({hip + Vector3{0, side * 0.08, 0}, knee, 0.09, 0.07}, cloth, 6);
    add({knee, foot, 0.07, 0.05}, cloth, 6);
    add({neck + Vector3{0, side * 0.18, -0.04}, handlebar + Vector3{0, side * 0.25, 0.03}, 0.06,
         0.04},
        cloth, 6);
  }
}

}  // namespace flagstone::sim
