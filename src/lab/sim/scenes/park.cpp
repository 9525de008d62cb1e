// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/people.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface gravel{.semantic = SemanticClass::sidewalk, .reflectivity = 0.38F};
constexpr Surface lawn{.semantic = SemanticClass::terrain, .reflectivity = 0.42F};
constexpr Surface mud{.semantic = SemanticClass::terrain, .reflectivity = 0.25F};
constexpr Surface water{
    .semantic = SemanticClass::other_ground, .reflectivity = 0.04F, .mirror = 0.9F};

constexpr double half_width = 75;

// A pond in a hollow with an even bank.
struct Pond {
  double x = 0, t = 0;           // middle, metres
  double along = 8, across = 5;  // half axes, metres
  double level = 0;              // of the water, metres

  // 0 in the middle, 1 on the shore.
  [[nodiscard]] double outward(double at_x, double at_t) const noexcept {
    return std::hypot((at_x - x) / along, (at_t - t) / across);
  }
};

// t is measured to the left of the main path, along y. A footpath is next to the main path.
struct Park {
  Extent extent;
  WindingPath path;
  double path_half_width = 2;
  double foot_path = 9;  // t, on the side away from the pond
  std::vector<Wave> hills, lawns, gravels;
  std::vector<Pond> ponds;

  static constexpr double foot_path_half_width = 0.9;

  [[nodiscard]] double land(double x, double t) const noexcept {
    const double beside = smooth_step(path_half_width, path_half_width + 2.5, std::abs(t));
    const double beside_foot_path =
        smooth_step(foot_path_half_width, foot_path_half_width + 1, std::abs(t - foot_path));
    return sum_at(hills, x, t) + beside * beside_foot_path * sum_at(lawns, x, t);
  }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const Pond& pond = pond_near(x);
    const double out = pond.outward(x, t);
    const double land_height = land(x, t);
    constexpr double bank_end = 1.9;  // of the slope from the shore up to the lawn
    if (out < 1) return pond.level;
    if (out < bank_end) {
      const double share = smooth_step(1, bank_end, out);
      return pond.level + share * (land_height - pond.level);
    }
    return on_gravel(t) ? land_height - 0.03 + sum_at(gravels, x, t) : land_height;
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = pond_near(x).outward(x, t);
    if (out < 0.97) return water;
    if (out < 1.06) return mud;
    return on_gravel(t) ? gravel : lawn;
  }
  [[nodiscard]] const Pond& pond_near(double x) const noexcept {
    return *std::ranges::min_element(ponds, {},
                                     [x](const Pond& pond) { return std::abs(pond.x - x); });
  }
  [[nodiscard]] bool on_gravel(double t) const noexcept {
    return std::abs(t) < path_half_width || std::abs(t - foot_path) < foot_path_half_width;
  }
};

Park draw_park(const Extent& extent, Random& random) {
  Park park;
  park.extent = extent;
  park.path = {.swing = (random.chance(0.5) ? 1 : -1) * random.uniform(3, 5.5),
               .swing_length = random.uniform(65, 110)};
  park.path_half_width = random.uniform(1.5, 2.2);
  draw_waves(park.hills, 4, {0.15, 0.45}, {45, 110}, random);
  draw_waves(park.lawns, 6, {0.02, 0.06}, {5, 18}, random);
  draw_waves(park.gravels, 6, {0.002, 0.005}, {0.8, 2.5}, random);
  park.path.swing_length = extent.fitted_length(park.path.swing_length);
  for (auto* waves : {&park.hills, &park.lawns, &park.gravels}) close_waves(*waves, extent);
  const double pond_side = random.chance(0.5) ? 1 : -1;
  park.foot_path = -pond_side * random.uniform(6.5, 10);
  constexpr std::size_t stretches_per_pond = 3;
  for (std::size_t i = 0; i < extent.stretches; i += stretches_per_pond) {
    const Interval x = extent.stretch(i).x;
    Pond pond{.x = random.uniform(x.low + 11, x.high - 11),
              .t = pond_side * random.uniform(16, 20),
              .along = random.uniform(7, 11),
              .across = random.uniform(4, 5.5)};
    pond.level = park.land(pond.x, pond.t) - random.uniform(0.5, 0.9);
    park.ponds.push_back(pond);
  }
  return park;
}

Ground make_park(const Park& park) {
  const double edge = park.path_half_width;
  std::vector<double> across = mirrored_lines(std::array{
      LineBand{edge, 0.25}, LineBand{edge + 3, 0.3}, LineBand{30, 0.6}, LineBand{half_width, 1.5}});
  across.push_back(park.foot_path - Park::foot_path_half_width);
  across.push_back(park.foot_path + Park::foot_path_half_width);
  finish_lines(across);
  const Interval all = park.extent.reach(79);
  const Interval fine = park.extent.reach(24);
  return cut_ground(
      {.x = lines_in_bands(all.low, std::array{LineBand{fine.low, 1}, LineBand{fine.high, 0.4},
                                               LineBand{all.high, 1}}),
       .t = std::move(across),
       .offset = [&](double x) { return park.path.y(x); },
       .height = [&](double x, double t) { return park.height(x, t); },
       .surface = [&](double x, double t) { return park.surface(x, t); },
       .closed = park.extent.closed});
}

// Unmown meadows: adjacent patches of high grass.
void grow_meadows(Mesh& mesh, const Park& park, const Ground& ground, const Stretch& stretch,
                  Random& random) {
  const Interval row = stretch.reach(12);
  const int meadows = count_of(5, 96, row);
  constexpr int patches = 5;
  for (int meadow = 0; meadow < meadows; ++meadow) {
    const double x = row.low + (row.high - row.low) * (meadow + random.uniform()) / meadows;
    const double side = random.chance(0.5) ? 1 : -1;
    const double t = side * random.uniform(5, 11);
    const double height = random.uniform(0.3, 0.8);
    for (int patch = 0; patch < patches; ++patch) {
      HighGrass grass{.x = x + random.uniform(-5, 5),
                      .radius = random.uniform(1.8, 3.3),
                      .height = height * random.uniform(0.85, 1)};
      const double nearest = park.path_half_width + 0.2 + grass.radius;
      const double at = side * std::max(nearest, std::abs(t) + random.uniform(-4, 4));
      if (std::abs(at - park.foot_path) < grass.radius + 1 ||
          park.pond_near(grass.x).outward(grass.x, at) < 1.3) {
        continue;
      }
      grass.y = park.path.y(grass.x) + at;
      add_high_grass(mesh, ground, grass, random);
    }
  }
}

void put_up_furniture(Mesh& mesh, const Park& park, const Ground& ground, const Stretch& stretch,
                      Random& random) {
  // A frame next to the path that faces it.
  const auto stand = [&](double x, double t) {
    const double y = park.path.y(x) + t;
    return upright_frame({x, y, ground.height(x, y)},
                         park.path.at(x).yaw + (t > 0 ? -1 : 1) * std::numbers::pi / 2);
  };
  const double lamp_side = random.chance(0.5) ? 1 : -1;
  for (double x = stretch.reach(49).low + random.uniform(0, 12); x < stretch.reach(54).high;
       x += random.uniform(18, 24)) {
    add_lamp_post(mesh, stand(x, lamp_side * (park.path_half_width + 0.6)));
  }
  const Interval row = stretch.reach(24);
  for (double x = row.low + random.uniform(0, 10); x < row.high; x += random.uniform(12, 22)) {
    const double side = random.chance(0.5) ? 1 : -1;
    add_bench(mesh, stand(x, side * (park.path_half_width + 0.7)));
    if (random.chance(0.6)) add_bin(mesh, stand(x + 1.6, side * (park.path_half_width + 0.6)));
    if (random.chance(0.4))
      add_person(mesh, stand(x + 0.5, side * (park.path_half_width + 2.2)), random);
  }
}

Mesh furnish_park(const Park& park, const Ground& ground, const Stretch& stretch, Random random) {
  Mesh mesh;
  // Plants on the lawns, neither in the water nor on a path.
  const auto grow = [&](double per_square_metre, Interval from_path, double clear, auto plant) {
    scatter(park.path, {.x = stretch.reach(54), .from_path = from_path}, per_square_metre, random,
            [&](double x, double y) {
              const double t = y - park.path.y(x);
              if (park.pond_near(x).outward(x, t) < 1.25 || std::abs(t - park.foot_path) < clear) {
                return;
              }
              plant(mesh, ground, x, y, random);
            });
  };
  grow(0.003, {5.2, 60}, 1.8, add_tree);
  grow(0.008, {park.path_half_width + 1.5, 35}, 2.3, add_bush);
  grow(0.004, {park.path_half_width + 1.8, 20}, 2.5, add_ground_cover);
  grow(0.25, {park.path_half_width + 0.2, 18}, 1, add_tuft);
  grow_meadows(mesh, park, ground, stretch, random);
  put_up_furniture(mesh, park, ground, stretch, random);
  return mesh;
}

// People on the footpath.
Traffic draw_walkers(const Park& park, std::vector<Stop> route, Random& random) {
  Traffic walkers(std::move(route), park.extent.view());
  const WindingPath path = park.path;
  const Interval walked = park.extent.run(19);
  const int count = count_of(9, 110, walked);
  for (int i = 0; i < count; ++i) {
    const double t = park.foot_path + random.uniform(-0.6, 0.6);
    const double speed = (random.chance(0.5) ? 1 : -1) * random.uniform(0.8, 1.8);
    walkers.join({.kind = RoadUser::person,
                  .at = along([path](double x) { return path.at(x); }, t,
                              random.uniform(walked.low, walked.high), speed),
                  .look = random.bits()});
  }
  return walkers;
}

}  // namespace

Landscape park(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  Park park = draw_park(extent, random);
  Ground ground = make_park(park);
  std::vector<Stop> route = wander_along([&](double x) { return park.path.at(x); }, random, extent);
  Traffic walkers = draw_walkers(park, route, random);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish =
              [park = std::move(park), random](const Ground& on, const Stretch& stretch) {
                return furnish_park(park, on, stretch, stretch.stream(random));
              },
          .moving = moving(std::move(walkers))};
}

}  // namespace flagstone::sim
