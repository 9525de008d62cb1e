// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/ground.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface bare_earth{.semantic = SemanticClass::other_ground, .reflectivity = 0.24F};
constexpr Surface leaf_litter{.semantic = SemanticClass::terrain, .reflectivity = 0.33F};
constexpr Surface moss{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface puddle{
    .semantic = SemanticClass::other_ground, .reflectivity = 0.05F, .mirror = 0.8F};

constexpr double half_width = 60;
constexpr double rut = 0.78;  // from the middle of the track to the middle of a rut, metres

// A root that crosses the track or ends on it, as a ridge.
struct Root {
  double x, slant;        // at the middle of the track, metres; dx / dt, m/m
  double t_begin, t_end;  // metres
  double height;          // metres
  [[nodiscard]] double at(double px, double pt) const noexcept {
    constexpr double half_width_of = 0.22;
    if (pt < t_begin || pt > t_end) return 0;
    return height * std::max(0.0, 1 - std::abs(px - x - slant * pt) / half_width_of);
  }
};

// The track is cut into a hillside, with a bank on the upper side and a shoulder on the lower side.
// t is measured to the left of the middle of the track, along y.
struct Track {
  Extent extent;
  WindingPath path;
  double uphill = 1;                   // +1: the hill rises to the left
  double side_slope = 0.05;            // of the hill, m/m
  double bank_height = 0.4;            // on the upper side
  double half_width = 1.7;             // of the level part between bank and shoulder
  std::array<double, 2> rut_depth{};   // right and left, metres
  double rut_wave = 0, rut_phase = 0;  // of the depth of the ruts along the track
  std::vector<Wave> hills, tilts, bumps, litter;
  std::vector<Root> roots;

  [[nodiscard]] double rut_depth_at(double x, double t) const noexcept {
    const bool left = t > 0;
    const double swell = 0.65 + 0.35 * std::sin(rut_wave * x + rut_phase + (left ? 1.3 : 0));
    const double aside = (std::abs(t) - rut) / 0.27;
    return rut_depth[left] * swell * std::max(0.0, 1 - aside * aside);
  }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double up = uphill * t;
    double land = sum_at(hills, x, 0.3 * t) + sum_at(bumps, x, t);
    // On the track the tilt is random; beyond it, it is the slope of the hill.
    land += sum_at(tilts, x, 0) * std::clamp(t, -half_width, half_width);
    if (up > half_width) {
      land += bank_height * smooth_step(half_width, half_width + 1.4, up) +
              side_slope * (up - half_width);
    } else if (up < -half_width) {
      land -=
          0.25 * smooth_step(half_width, half_width + 0.8, -up) + side_slope * (-up - half_width);
    }
    constexpr double root_reach = 2;  // along x, on either side of its middle
    auto root = std::ranges::lower_bound(roots, x - root_reach, {}, &Root::x);
    for (; root != roots.end() && root->x < x + root_reach; ++root) land += root->at(x, t);
    return land - rut_depth_at(x, t) + 0.05 * std::max(0.0, 1 - t * t / 0.16);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    if (rut_depth_at(x, t) > 0.02) return rut_depth_at(x, t) > 0.155 ? puddle : bare_earth;
    return sum_at(litter, x, t) > 1 ? moss : leaf_litter;
  }
};

Track draw_track(const Extent& extent, Random& random) {
  Track track;
  track.extent = extent;
  track.path = {.swing = random.uniform(-5, 5), .swing_length = random.uniform(60, 100)};
  track.uphill = random.chance(0.5) ? 1 : -1;
  track.side_slope = random.uniform(0.02, 0.1);
  track.bank_height = random.uniform(0.15, 0.55);
  track.half_width = random.uniform(1.6, 2);
  for (double& depth : track.rut_depth) depth = random.uniform(0.06, 0.18);
  track.rut_wave = 2 * std::numbers::pi / random.uniform(7, 16);
  track.rut_phase = random.uniform(0, 6);
  draw_waves(track.hills, 3, {0.4, 0.9}, {35, 80}, random);
  draw_waves(track.bumps, 6, {0.015, 0.05}, {3, 9}, random);
  draw_waves(track.bumps, 6, {0.004, 0.01}, {0.8, 1.8}, random);
  draw_waves(track.tilts, 3, {0.02, 0.045}, {9, 25}, random);
  draw_waves(track.litter, 5, {0.5, 1}, {3, 12}, random);
  const Interval rooted = extent.reach(19, 3);
  for (double x = rooted.low; x < rooted.high; x += random.uniform(1.2, 5)) {
    const bool whole = random.chance(0.3);
    const double side = random.chance(0.5) ? 1 : -1;
    const double begin = whole ? -2.2 : std::min(side * 0.2, side * 2.4);
    track.roots.push_back({.x = x,
                           .slant = random.uniform(-0.6, 0.6),
                           .t_begin = begin,
                           .t_end = whole ? 2.2 : begin + 2.2,
                           .height = random.uniform(0.03, 0.07)});
  }
  track.path.swing_length = extent.fitted_length(track.path.swing_length);
  track.rut_wave = extent.fitted(track.rut_wave);
  for (auto* waves : {&track.hills, &track.bumps, &track.tilts, &track.litter}) {
    close_waves(*waves, extent);
  }
  return track;
}

Ground make_track(const Track& track) {
  const Interval all = track.extent.reach(76);
  const Interval fine = track.extent.reach(19);
  return cut_ground(
      {.x = lines_in_bands(all.low, std::array{LineBand{fine.low, 0.8}, LineBand{fine.high, 0.22},
                                               LineBand{all.high, 0.8}}),
       .t = mirrored_lines(std::array{LineBand{0.4, 0.2}, LineBand{1.2, 0.1}, LineBand{3.2, 0.2},
                                      LineBand{14, 0.5}, LineBand{half_width, 1.5}}),
       .offset = [&](double x) { return track.path.y(x); },
       .height = [&](double x, double t) { return track.height(x, t); },
       .surface = [&](double x, double t) { return track.surface(x, t); },
       .closed = track.extent.closed});
}

Mesh furnish_forest(const Track& track, const Ground& ground, const Stretch& stretch,
                    Random random) {
  Mesh mesh;
  const auto grow = [&](double per_square_metre, Interval from_path, auto plant) {
    scatter(track.path, {.x = stretch.reach(54), .from_path = from_path}, per_square_metre, random,
            [&](double x, double y) { plant(x, y); });
  };
  const auto turned = [&] { return random.uniform(0, 2 * std::numbers::pi); };
  grow(0.045, {2.9, 26}, [&](double x, double y) { add_forest_tree(mesh, ground, x, y, random); });
  grow(0.015, {26, 50}, [&](double x, double y) { add_forest_tree(mesh, ground, x, y, random); });
  grow(0.012, {3, 25}, [&](double x, double y) { add_bush(mesh, ground, x, y, random); });
  grow(0.3, {2.1, 14}, [&](double x, double y) { add_fern(mesh, ground, x, y, random); });
  grow(0.02, {3.6, 16}, [&](double x, double y) { add_ground_cover(mesh, ground, x, y, random); });
  grow(0.6, {1.4, 6}, [&](double x, double y) { add_tuft(mesh, ground, x, y, random); });
  grow(0.5, {0, 0.35}, [&](double x, double y) { add_tuft(mesh, ground, x, y, random); });
  grow(0.006, {5.6, 22},
       [&](double x, double y) { add_fallen_log(mesh, ground, x, y, turned(), random); });
  grow(0.01, {2.6, 18}, [&](double x, double y) { add_stump(mesh, ground, x, y, random); });
  // Boughs that reach over the edges of the track.
  const Interval row = stretch.reach(24);
  for (double x = row.low; x < row.high; x += random.uniform(5, 14)) {
    const double side = random.chance(0.5) ? 1 : -1;
    const double y = track.path.y(x) + side * random.uniform(3.8, 4.6);
    add_low_branch(mesh, ground, x, y, -side * std::numbers::pi / 2 + random.uniform(-0.4, 0.4),
                   random);
  }
  return mesh;
}

// People walk next to the track.
Traffic draw_walkers(const Track& track, std::vector<Stop> route, Random& random) {
  Traffic walkers(std::move(route), track.extent.view());
  const WindingPath path = track.path;
  const Interval walked = track.extent.run(4);
  const int count = count_of(3, 80, walked);
  for (int i = 0; i < count; ++i) {
    const double t = (random.chance(0.5) ? 1 : -1) * random.uniform(4.3, 6);
    const double speed = (random.chance(0.5) ? 1 : -1) * random.uniform(0.8, 1.8);
    walkers.join({.kind = RoadUser::person,
                  .at = along([path](double x) { return path.at(x); }, t,
                              random.uniform(walked.low, walked.high), speed),
                  .look = random.bits()});
  }
  return walkers;
}

}  // namespace

Landscape forest_track(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  Track track = draw_track(extent, random);
  Ground ground = make_track(track);
  std::vector<Stop> route =
      wander_along([&](double x) { return track.path.at(x); }, random, extent);
  Traffic walkers = draw_walkers(track, route, random);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish =
              [track = std::move(track), random](const Ground& on, const Stretch& stretch) {
                return furnish_forest(track, on, stretch, stretch.stream(random));
              },
          .moving = moving(std::move(walkers))};
}

}  // namespace flagstone::sim
