// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/plants.hpp"

#include <cmath>
#include <numbers>

#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

namespace {

constexpr Surface bark{.semantic = SemanticClass::trunk, .reflectivity = 0.33F};
constexpr Surface foliage{.semantic = SemanticClass::vegetation, .reflectivity = 0.42F};

Vector3 on_ground(const Ground& ground, double x, double y) { return {x, y, ground.height(x, y)}; }

}  // namespace

void add_tree(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const Vector3 foot = on_ground(ground, x, y);
  const Frame frame = upright_frame(foot, random.uniform(0, 2 * std::numbers::pi));
  const double crown_radius = random.uniform(1.6, 3);
  const double crown_half_height = crown_radius * random.uniform(0.8, 1.3);
  const double crown_base = random.uniform(1.2, 2.4);
  const double middle = crown_base + crown_half_height;
  const double radius = 0.06 * crown_radius + 0.04;

  add_cone(mesh, frame,
           {.from = {0, 0, -0.3},
            .to = {0, 0, middle},
            .radius_from = radius,
            .radius_to = 0.5 * radius},
           bark);
  constexpr int boughs = 5;
  for (int bough = 0; bough < boughs; ++bough) {
    const double angle = 2 * std::numbers::pi * (bough + random.uniform()) / boughs;
    const double reach = 0.7 * crown_radius;
    add_cone(mesh, frame,
             {.from = {0, 0, random.uniform(0.9, 1.1) * crown_base},
              .to = {reach * std::cos(angle), reach * std::sin(angle), middle},
              .radius_from = 0.4 * radius,
              .radius_to = 0.15 * radius,
              .sides = 6},
             bark);
  }
  add_leaves(mesh,
             {.centre = foot + Vector3{0, 0, middle},
              .radii = {crown_radius, crown_radius, crown_half_height},
              .count = static_cast<int>(260 * crown_radius * crown_radius),
              .size = 0.17},
             foliage, random);
}

void add_bush(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const double radius = random.uniform(0.5, 1.1);
  const double half_height = random.uniform(0.35, 0.9);
  add_leaves(mesh,
             {.centre = on_ground(ground, x, y) + Vector3{0, 0, 0.85 * half_height},
              .radii = {radius, radius, half_height},
              .count = static_cast<int>(500 * radius),
              .size = 0.12},
             foliage, random);
}

void add_tuft(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  constexpr int blades = 4;
  const double height = random.uniform(0.05, 0.25);
  for (int blade = 0; blade < blades; ++blade) {
    const double angle = random.uniform(0, std::numbers::pi);
    const Vector3 aside = 0.08 * Vector3{std::cos(angle), std::sin(angle), 0};
    const double dx = random.uniform(-0.1, 0.1);
    const double dy = random.uniform(-0.1, 0.1);
    const Vector3 foot = on_ground(ground, x + dx, y + dy);
    const Vector3 tip = foot + Vector3{dx, dy, height};
    mesh.add_quad(foot - aside, foot + aside, tip + 0.5 * aside, tip - 0.5 * aside, foliage);
  }
}

void add_ground_cover(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const double radius = random.uniform(0.5, 1.5);
  const double height = random.uniform(0.08, 0.35);
  const int leaves = static_cast<int>(260 * radius * radius);
  for (int leaf = 0; leaf < leaves; ++leaf) {
    const double from_middle = radius * std::sqrt(random.uniform());
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Vector3 foot =
        on_ground(ground, x + from_middle * std::cos(angle), y + from_middle * std::sin(angle));
    // The patch is lower towards its edge.
    const double edge = 1 - 0.7 * from_middle / radius;
    const double turn = random.uniform(0, std::numbers::pi);
    const double half = random.uniform(0.03, 0.06);
    const Vector3 aside = half * Vector3{std::cos(turn), std::sin(turn), 0};
    const Vector3 along = half * normalized({-std::sin(turn), std::cos(turn), random.uniform()});
    const Vector3 centre = foot + Vector3{0, 0, random.uniform(0.06, 0.06 + height * edge)};
    mesh.add_quad(centre - aside - along, centre + aside - along, centre + aside + along,
                  centre - aside + along, foliage);
  }
}

void add_hedge(Mesh& mesh, const Ground& ground, const Hedge& hedge, Random& random) {
  constexpr double piece = 0.5;
  const double along = std::hypot(hedge.x1 - hedge.x0, hedge.y1 - hedge.y0);
  const double yaw = std::atan2(hedge.y1 - hedge.y0, hedge.x1 - hedge.x0);
  const int pieces = static_cast<int>(std::ceil(along / piece));
  for (int i = 0; i < pieces; ++i) {
    const double share = (i + 0.5) / pieces;
    const Vector3 foot = on_ground(ground, hedge.x0 + share * (hedge.x1 - hedge.x0),
                                   hedge.y0 + share * (hedge.y1 - hedge.y0));
    const double core_half_width = 0.3 * hedge.width;
    add_box(mesh, upright_frame(foot, yaw),
            {.low = {-piece / 2, -core_half_width, 0.1},
             .high = {piece / 2, core_half_width, 0.8 * hedge.height}},
            foliage);
    add_leaves(mesh,
               {.centre = foot + Vector3{0, 0, hedge.height / 2},
                .radii = {0.6 * hedge.width, 0.6 * hedge.width, hedge.height / 2},
                .count = 120,
                .size = 0.1},
               foliage, random);
  }
}

namespace {

constexpr Surface wild_bark{.semantic = SemanticClass::trunk, .reflectivity = 0.3F};
constexpr Surface straw{.semantic = SemanticClass::vegetation, .reflectivity = 0.5F};
constexpr double full_turn = 2 * std::numbers::pi;
constexpr double buried = 0.3;  // metres, for slopes

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
           wild_bark);
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
             wild_bark);
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
           wild_bark);
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
           wild_bark);
}

void add_stump(Mesh& mesh, const Ground& ground, double x, double y, Random& random) {
  const double radius = random.uniform(0.12, 0.3);
  add_cone(mesh, upright_frame(on_ground(ground, x, y), 0),
           {.from = {0, 0, -buried},
            .to = {0, 0, random.uniform(0.2, 0.5)},
            .radius_from = 1.2 * radius,
            .radius_to = radius},
           wild_bark);
}

}  // namespace flagstone::sim
