// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 115;  // of the ground, metres
constexpr double half_width = 75;
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface earth{.semantic = SemanticClass::other_ground, .reflectivity = 0.27F};

// A step along the path, beyond which the land is higher or lower.
struct Bank {
  double t;       // start, metres from the path, signed
  double width;   // metres
  double height;  // metres; negative for a drop
  [[nodiscard]] double at(double pt) const noexcept {
    const double beyond = (t > 0 ? pt - t : t - pt) / width;
    const double step = std::clamp(beyond, 0.0, 1.0);
    return height * step * step * (3 - 2 * step);
  }
};

// The path of the vehicle and the land around it; t is measured to the left of the path, along y.
struct Field {
  WindingPath path;
  std::vector<Wave> waves;
  std::vector<Wave> soil;  // the earth is bare where their sum is high
  std::vector<Mound> mounds;
  std::vector<Bank> banks;

  [[nodiscard]] double height(double x, double t) const noexcept {
    double height = sum_at(waves, x, t);
    for (const Mound& mound : mounds) height += mound.at(x, t);
    for (const Bank& bank : banks) height += bank.at(t);
    return height;
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    return sum_at(soil, x, t) > 0.8 ? earth : grass;
  }
};

// Mounds are gentler on the path of the vehicle.
Mound draw_mound(Random& random) {
  const double t = random.uniform(-35, 35);
  const double radius = random.uniform(2.5, 8);
  const double passable = std::min(1.0, 0.3 + std::abs(t) / 20);
  const double steepness = passable * random.uniform(0.06, 0.24);  // maximum slope / 1.54
  const double up = random.chance(0.5) ? 1 : -1;
  return {
      .x = random.uniform(-90, 90), .t = t, .radius = radius, .height = up * steepness * radius};
}

Field draw_field(Random& random) {
  Field field{.path = {.swing = random.uniform(-4, 4), .swing_length = random.uniform(80, 140)},
              .waves = {},
              .soil = {},
              .mounds = {},
              .banks = {}};
  draw_waves(field.waves, 4, {0.3, 0.9}, {50, 120}, random);     // hills
  draw_waves(field.waves, 6, {0.02, 0.09}, {6, 16}, random);     // swells
  draw_waves(field.waves, 8, {0.006, 0.022}, {1.4, 4}, random);  // bumps
  draw_waves(field.soil, 5, {0.5, 1}, {5, 25}, random);
  constexpr int mounds = 60;
  for (int i = 0; i < mounds; ++i) field.mounds.push_back(draw_mound(random));
  for (const double side : {-1.0, 1.0}) {
    field.banks.push_back({.t = side * random.uniform(6, 18),
                           .width = random.uniform(2.5, 5),
                           .height = random.uniform(-1.5, 1.5)});
  }
  return field;
}

// Lines are dense near the path, where single bumps are visible.
std::vector<double> lines_across() {
  constexpr double fine_half_width = 20;
  constexpr double fine = 0.3;
  constexpr double coarse = 1;
  std::vector<double> lines;
  for (double t = 0; t < fine_half_width; t += fine) lines.push_back(t);
  for (double t = fine_half_width; t <= half_width; t += coarse) lines.push_back(t);
  const std::vector<double> left = lines;
  for (const double t : left) {
    if (t > 0) lines.push_back(-t);
  }
  std::ranges::sort(lines);
  return lines;
}

Ground make_field(const Field& field) {
  constexpr double step = 0.35;
  GroundGrid grid{.x = {}, .offset = {}, .t = lines_across()};
  for (double x = -half_length; x <= half_length; x += step) {
    grid.x.push_back(x);
    grid.offset.push_back(field.path.y(x));
  }
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    for (const double t : grid.t) heights.push_back(field.height(grid.x[i], t));
    if (i + 1 == grid.x.size()) break;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(field.surface(grid.x[i], grid.t[j]));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

using Plant = void(Mesh&, const Ground&, double x, double y, Random&);

void put_up_fence(Mesh& mesh, const Field& field, const Ground& ground, Random& random) {
  constexpr double piece = 6;  // length of a straight piece of the fence, metres
  const double t = (random.chance(0.5) ? 1 : -1) * random.uniform(9, 20);
  const double begin = random.uniform(-80, -20);
  const double end = begin + random.uniform(40, 80);
  for (double x = begin; x < end; x += piece) {
    add_fence(
        mesh, ground,
        {.x0 = x, .y0 = field.path.y(x) + t, .x1 = x + piece, .y1 = field.path.y(x + piece) + t});
  }
}

Mesh furnish_field(const Field& field, const Ground& ground, Random random) {
  Mesh mesh;
  const auto grow = [&](double per_square_metre, Interval from_path, Plant* plant) {
    scatter(field.path, {.from_path = from_path}, per_square_metre, random,
            [&](double x, double y) { plant(mesh, ground, x, y, random); });
  };
  grow(0.003, {6, 60}, add_tree);
  grow(0.008, {2.8, 40}, add_bush);
  grow(0.01, {2.8, 25}, add_ground_cover);
  grow(1.5, {0.5, 20}, add_tuft);
  put_up_fence(mesh, field, ground, random);
  return mesh;
}

}  // namespace

Landscape bumpy_field(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Field field = draw_field(random);
  Ground ground = make_field(field);
  std::vector<Stop> route = wander_along([&](double x) { return field.path.at(x); }, random);
  return {
      .ground = std::move(ground),
      .route = std::move(route),
      .furnish = [field = std::move(field), random](const Ground& on, const Stretch& /*whole*/) {
        return furnish_field(field, on, random);
      }};
}

}  // namespace flagstone::sim
