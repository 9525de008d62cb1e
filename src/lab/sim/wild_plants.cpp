// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/wild_plants.hpp"

#include <cmath>
#include <numbers>

#include "lab/sim/shapes.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface bark{.semantic = SemanticClass::trunk, .reflectivity = 0.3F};
constexpr Surface foliage{.semantic = SemanticClass::vegetation, .reflectivity = 0.42F};
constexpr Surface straw{.semantic = SemanticClass::vegetation, .reflectivity = 0.5F};
constexpr double full_turn = 2 * std::numbers::pi;
constexpr double buried = 0.3;  // metres, for slopes

Vector3 on_ground(const Ground& ground, double x, double y) { return {x, y, ground.height(x, y)}; }

Vector3 level(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

}  // namespace

void add_high_grass(Mesh& mesh, const Ground& ground, const HighGrass& grass, Random& random) {
  constexpr double blades_a_square_metre = 90;
  const int blades =
      static_cast<int>(blades_a_square_metre * std::numbers::pi * grass.radius * grass.radius);
  for (int blade = 0; blade < blades; ++blade) {
    const double share = std::sqrt(random.uniform());
    const Vector3 from_middle = share * grass.radius * level(random.uniform(0, full_turn));
    const Vector3 foot = on_ground(ground, grass.x + from_middle.x, grass.y + from_middle.y);
    const double edge = share < 0.7 ? 1 : 1 - (share - 0.7) / 0.5;
    const double height = grass.height * edge * random.uniform(0.5, 1);
    const Vector3 aside = random.uniform(0.015, 0.03) * level(random.uniform(0, full_turn));
    const Vector3 lean = 0.35 * height * random.uniform() * level(random.uniform(0, full_turn));
    mesh.add_triangle(foot - aside, foot + aside, foot + lean + Vector3{0, 0, height},
                      random.chance(0.4) ? straw : foliage);
  }
}

void add_fern(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  constexpr int fronds = 9;
  const Vector3 foot = on_ground(ground, x, y);
  const double height = random.uniform(0.4, 0.9);
  for (int frond = 0; frond < fronds; ++frond) {
    const double angle = full_turn * (frond + random.uniform()) / fronds;
    const double reach = height * random.uniform(0.6, 1);
    const Vector3 out = level(angle);
    const Vector3 aside = 0.13 * height * level(angle + std::numbers::pi / 2);
    const Vector3 bend = foot + 0.5 * reach * out + Vector3{0, 0, random.uniform(0.8, 1) * height};
    const Vector3 tip = foot + reach * out + Vector3{0, 0, random.uniform(0.4, 0.75) * height};
    mesh.add_triangle(foot, bend - aside, bend + aside, foliage);
    mesh.add_triangle(tip, bend - aside, bend + aside, foliage);
  }
}

void add_forest_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const Vector3 foot = on_ground(ground, x, y);
  const Frame frame = upright_frame(foot, random.uniform(0, full_turn));
  const double height = random.uniform(9, 16);
  const double radius = 0.012 * height + random.uniform(-0.04, 0.08);
  const double lean = random.uniform(0, 0.04) * height;
  add_cone(mesh, frame,
           {.from = {0, 0, -buried},
            .to = {lean, 0, 0.9 * height},
            .radius_from = radius,
            .radius_to = 0.3 * radius,
            .sides = 8},
           bark);
  const auto dead_branches = static_cast<int>(random.uniform(0, 6));
  for (int branch = 0; branch < dead_branches; ++branch) {
    const double low = random.uniform(1.5, 5);
    const double reach = random.uniform(0.4, 1.2);
    const Vector3 out = level(random.uniform(0, full_turn));
    add_cone(mesh, frame,
             {.from = {lean * low / height, 0, low},
              .to = reach * out + Vector3{0, 0, low + random.uniform(-0.2, 0.3)},
              .radius_from = 0.025,
              .radius_to = 0.008,
              .sides = 3},
             bark);
  }
  const double crown = random.uniform(1.2, 2.2);
  const double half_height = random.uniform(0.2, 0.3) * height;
  add_leaves(mesh,
             {.centre = foot + Vector3{0, 0, height - half_height},
              .radii = {crown, crown, half_height},
              .count = 150,
              .size = 0.5},
             foliage, random);
}

void add_low_branch(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random) {
  const Frame frame = upright_frame(on_ground(ground, x, y), yaw);
  const Vector3 tip{2, 0, random.uniform(1, 1.6)};
  add_cone(mesh, frame,
           {.from = {0, 0, 2}, .to = tip, .radius_from = 0.04, .radius_to = 0.01, .sides = 4},
           bark);
  add_leaves(mesh,
             {.centre = frame.to_world(0.75 * tip + Vector3{0, 0, 0.5}),
              .radii = {0.6, 0.6, 0.3},
              .count = 90,
              .size = 0.12},
             foliage, random);
}

void add_fallen_log(Mesh& mesh, const Ground& ground, double x, double y, double yaw,
                    Random& random) {
  const double half_length = random.uniform(1.5, 3.5);
  const double radius = random.uniform(0.1, 0.28);
  const auto end = [&](double side) {
    const Vector3 away = side * half_length * level(yaw);
    return on_ground(ground, x + away.x, y + away.y) + Vector3{0, 0, 0.8 * radius};
  };
  add_cone(mesh, Frame{},
           {.from = end(-1),
            .to = end(1),
            .radius_from = radius,
            .radius_to = 0.75 * radius,
            .sides = 8},
           bark);
}

void add_stump(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const double radius = random.uniform(0.12, 0.3);
  add_cone(mesh, upright_frame(on_ground(ground, x, y), 0),
           {.from = {0, 0, -buried},
            .to = {0, 0, random.uniform(0.2, 0.5)},
            .radius_from = 1.2 * radius,
            .radius_to = radius},
           bark);
}

}  // namespace flagstone::sim
