// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/goods.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/people.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 112;  // of the ground, metres
constexpr double half_width = 70;
constexpr double haul_road = 2.6;  // half of its width, metres

constexpr Surface hardcore{.semantic = SemanticClass::other_ground, .reflectivity = 0.33F};
constexpr Surface earth{.semantic = SemanticClass::terrain, .reflectivity = 0.25F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface puddle{
    .semantic = SemanticClass::other_ground, .reflectivity = 0.05F, .mirror = 0.8F};
constexpr Surface clay_pipe{.semantic = SemanticClass::other_object, .reflectivity = 0.3F};

// t is measured to the left of the middle of the haul road, along y.
struct Site {
  WindingPath path;
  double pit_side = 1;  // +1: the pit is to the left, the trench to the right
  double fence = 30;    // distance of the fence from the path, metres
  Pit pit;
  Trench trench;
  std::vector<Wave> hills, churned, wet;
  std::vector<Mound> mounds;  // low enough for a vehicle

  [[nodiscard]] bool on_site(double t) const noexcept { return std::abs(t) < fence; }
  [[nodiscard]] double dug(double x, double t) const noexcept {
    const double to_pit = pit_side * t;
    return to_pit > 0 ? pit.at(x, to_pit) : trench.at(x, -to_pit);
  }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double beside = smooth_step(haul_road, haul_road + 1.5, std::abs(t));
    const double on = 1 - smooth_step(fence - 2, fence + 2, std::abs(t));
    double rough = sum_at(churned, x, t) * (0.35 + 0.65 * beside);
    for (const Mound& mound : mounds) rough += beside * mound.at(x, t);
    return sum_at(hills, x, t) + (0.2 + 0.8 * on) * rough + dug(x, t);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    if (!on_site(t)) return grass;
    if (std::abs(t) < haul_road) return sum_at(wet, x, t) > 2 ? puddle : hardcore;
    return earth;
  }
  // Whether the position is more than `clear` metres from pit and trench.
  [[nodiscard]] bool is_free(double x, double t, double clear) const noexcept {
    const double to_pit = pit_side * t;
    const bool beside_pit = x > pit.x_begin - clear && x < pit.x_end + clear &&
                            to_pit > pit.t_near - clear && to_pit < pit.t_far + clear;
    const bool beside_trench = x > trench.x_begin - clear && x < trench.x_end + clear &&
                               -to_pit > trench.t_near - clear &&
                               -to_pit < trench.t_near + trench.width + clear;
    return !beside_pit && !beside_trench;
  }
  [[nodiscard]] Frame stand(const Ground& ground, double x, double t, double turned) const {
    const double y = path.y(x) + t;
    return upright_frame({x, y, ground.height(x, y)}, path.at(x).yaw + turned);
  }
};

Site draw_site(Random& random) {
  Site site;
  site.path = {.swing = random.uniform(-3, 3), .swing_length = random.uniform(80, 130)};
  site.pit_side = random.chance(0.5) ? 1 : -1;
  site.fence = random.uniform(27, 34);
  const double pit_begin = random.uniform(-30, 0);
  const double near = random.uniform(6.5, 9);
  site.pit = {.x_begin = pit_begin,
              .x_end = pit_begin + random.uniform(24, 34),
              .t_near = near,
              .t_far = near + random.uniform(10, 14),
              .depth = random.uniform(1, 3),
              .run = random.uniform(0.5, 0.9),
              .ramp = random.uniform(5.5, 7)};
  const double trench_begin = random.uniform(-35, -10);
  site.trench = {.x_begin = trench_begin,
                 .x_end = trench_begin + random.uniform(25, 40),
                 .t_near = random.uniform(4, 6),
                 .width = random.uniform(0.8, 1.4),
                 .depth = random.uniform(0.8, 1.6)};
  draw_waves(site.hills, 3, {0.1, 0.3}, {40, 100}, random);
  draw_waves(site.churned, 7, {0.01, 0.035}, {2, 7}, random);
  draw_waves(site.churned, 7, {0.004, 0.012}, {0.9, 2}, random);
  draw_waves(site.wet, 5, {0.5, 1}, {3, 12}, random);
  for (int i = 0; i < 26; ++i) {
    const double radius = random.uniform(1.2, 4);
    site.mounds.push_back({.x = random.uniform(-70, 70),
                           .t = random.uniform(-26, 26),
                           .radius = radius,
                           .height = radius * random.uniform(-0.12, 0.2)});
  }
  return site;
}

Ground make_site(const Site& site) {
  const Pit& pit = site.pit;
  const Trench& trench = site.trench;
  const double side = pit.run * pit.depth;
  const double begin = trench.t_near;
  const double end = trench.t_near + trench.width;
  std::vector<double> across =
      mirrored_lines(std::array{LineBand{haul_road, 0.25}, LineBand{20, 0.35},
                                LineBand{site.fence + 2, 0.6}, LineBand{half_width, 1.5}});
  for (const double out : {pit.t_near, pit.t_near + side, pit.t_far - side, pit.t_far}) {
    across.push_back(site.pit_side * out);
  }
  for (const double out : {begin, begin + Trench::face, end - Trench::face, end}) {
    across.push_back(-site.pit_side * out);
  }
  finish_lines(across);
  std::vector<double> lengthwise = lines_in_bands(
      -half_length, std::array{LineBand{-50, 1}, LineBand{50, 0.35}, LineBand{half_length, 1}});
  for (const double x :
       {pit.x_begin, pit.x_begin + pit.ramp * pit.depth, pit.x_end - side, pit.x_end,
        trench.x_begin, trench.x_begin + Trench::face, trench.x_end - Trench::face, trench.x_end}) {
    lengthwise.push_back(x);
  }
  finish_lines(lengthwise);
  return cut_ground({.x = std::move(lengthwise),
                     .t = std::move(across),
                     .offset = [&](double x) { return site.path.y(x); },
                     .height = [&](double x, double t) { return site.height(x, t); },
                     .surface = [&](double x, double t) { return site.surface(x, t); }});
}

// Panels along both sides, except for gates.
void fence_in(Mesh& mesh, const Site& site, const Ground& ground, Random& random) {
  constexpr double panel = 3.5;
  for (const double side : {-1.0, 1.0}) {
    for (double x = -70; x < 70; x += panel) {
      if (random.chance(0.08)) continue;
      add_mesh_panel(mesh, site.stand(ground, x, side * site.fence, random.uniform(-0.05, 0.05)));
    }
  }
}

// Excavated earth lies along the trench, a pipe lies in it, and boards lead across.
void furnish_trench(Mesh& mesh, const Site& site, const Ground& ground, Random& random) {
  const Trench& trench = site.trench;
  const double middle = trench.t_near + trench.width / 2;
  constexpr double pipe = 4;
  for (double x = trench.x_begin + 1; x + pipe < trench.x_end - 1; x += pipe) {
    if (random.chance(0.3)) continue;
    const Frame frame = site.stand(ground, x + pipe / 2, -site.pit_side * middle, 0);
    add_cone(mesh, frame,
             {.from = {-pipe / 2, 0, 0.2},
              .to = {pipe / 2, 0, 0.2},
              .radius_from = 0.2,
              .radius_to = 0.2},
             clay_pipe);
  }
  for (double x = trench.x_begin + 3; x < trench.x_end - 2; x += random.uniform(2.5, 5)) {
    const double t = -site.pit_side * (trench.t_near + trench.width + random.uniform(2, 2.5));
    add_heap(mesh, ground,
             {.x = x, .y = site.path.y(x) + t, .radius = random.uniform(0.8, 1.5), .stretch = 1.6},
             random);
  }
}

// Draws positions on the site until one has the requested distance from the path and is clear of
// holes.
class FreePlaces {
 public:
  FreePlaces(const Site& site, Random& random) : site_(site), random_(random) {}

  struct Place {
    double x, t;
  };
  Place next(Interval from_path, double clear) {
    while (true) {
      const double side = random_.chance(0.5) ? 1 : -1;
      const Place place{random_.uniform(-55, 55),
                        side * random_.uniform(from_path.low, from_path.high)};
      if (site_.is_free(place.x, place.t, clear)) return place;
    }
  }

 private:
  const Site& site_;
  Random& random_;
};

Mesh furnish_site(const Site& site, const Ground& ground, Random random) {
  Mesh mesh;
  fence_in(mesh, site, ground, random);
  furnish_trench(mesh, site, ground, random);
  FreePlaces places(site, random);
  const auto turned = [&] { return random.uniform(0, 2 * std::numbers::pi); };
  const auto put = [&](int count, Interval from_path, double clear, auto add) {
    for (int i = 0; i < count; ++i) {
      const auto [x, t] = places.next(from_path, clear);
      add(site.stand(ground, x, t, turned()));
    }
  };
  put(9, {7, 25}, 4, [&](const Frame& frame) {
    add_heap(mesh, ground,
             {.x = frame.origin.x,
              .y = frame.origin.y,
              .radius = random.uniform(1.5, 4),
              .stretch = random.uniform(1, 1.5)},
             random);
  });
  put(5, {8, 25}, 3.5,
      [&](const Frame& frame) { add_pipe_stack(mesh, frame, random.uniform(3, 6), random); });
  put(14, {4, 20}, 1.2, [&](const Frame& frame) { add_brick_pallet(mesh, frame, random); });
  put(16, {3.8, 16}, 2.6, [&](const Frame& frame) { add_board(mesh, frame, random); });
  put(3, {20, 25}, 3.5, [&](const Frame& frame) { add_container(mesh, frame); });
  put(5, {5, 18}, 0.6, [&](const Frame& frame) { add_person(mesh, frame, random); });
  // Barriers at the edge of the haul road, on the side of the pit.
  add_concrete_barrier(mesh, site.pit_side * (site.pit.t_near - 1.2),
                       {site.pit.x_begin, site.pit.x_begin + 16},
                       [&](double x, double t, double z) {
                         const double y = site.path.y(x) + t;
                         return Vector3{x, y, ground.height(x, y) + z};
                       });
  const auto grow = [&](double per_square_metre, Interval from_path, auto plant) {
    scatter(site.path, {.from_path = from_path}, per_square_metre, random,
            [&](double x, double y) { plant(mesh, ground, x, y, random); });
  };
  grow(0.002, {site.fence + 3, 60}, add_tree);
  grow(0.006, {site.fence + 1, 55}, add_bush);
  grow(0.04, {site.fence - 4, site.fence + 6}, add_ground_cover);
  return mesh;
}

// An excavator, which stays in one position and swings.
struct Digging {
  double x = 0, t = 0, yaw = 0;
  double swing = 0, turn = 0.5;  // at stop 0, and per stop, radians
};

Digging draw_digging(const Site& site, Random& random) {
  FreePlaces places(site, random);
  constexpr double tracks = 2.6;
  const auto [x, t] = places.next({excavator_reach + 4, site.fence - excavator_reach}, tracks);
  return {.x = x,
          .t = t,
          .yaw = random.uniform(0, 2 * std::numbers::pi),
          .swing = random.uniform(0, 2 * std::numbers::pi),
          .turn = random.uniform(0.25, 0.6)};
}

// Workers walk between the haul road and the pit.
Traffic draw_workers(const Site& site, std::vector<Stop> route, Random& random) {
  Traffic workers(std::move(route));
  for (int i = 0; i < 5; ++i) {
    const double t = site.pit_side * random.uniform(3.9, 4.6);
    const double speed = (random.chance(0.5) ? 1 : -1) * random.uniform(0.8, 1.8);
    workers.join({.kind = RoadUser::person,
                  .at = along([path = site.path](double x) { return path.at(x); }, t,
                              random.uniform(-40, 40), speed),
                  .look = random.bits()});
  }
  return workers;
}

void add_excavator_at_work(Mesh& mesh, const Ground& ground, const WindingPath& path,
                           const Digging& digging, double seconds) {
  constexpr double tracks_length = 3.6;
  constexpr double tracks_width = 2.2;
  const double y = path.y(digging.x) + digging.t;
  const std::size_t first = mesh.triangles().size();
  add_excavator(mesh,
                frame_on_wheels(ground, digging.x, y, digging.yaw, tracks_length, tracks_width),
                {.swing = digging.swing + seconds * digging.turn,
                 .boom = 0.55 + 0.25 * std::sin(1.3 * seconds)});
  mesh.set_motion(first, Motion::now);
}

}  // namespace

Landscape construction_site(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Site site = draw_site(random);
  Ground ground = make_site(site);
  std::vector<Stop> route = wander_along([&](double x) { return site.path.at(x); }, random);
  const Digging digging = draw_digging(site, random);
  Traffic workers = draw_workers(site, route, random);
  const WindingPath path = site.path;
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [site, random](
                         const Ground& on,
                         const Stretch& /*whole*/) { return furnish_site(site, on, random); },
          .moving =
              [path, digging, workers = std::move(workers)](const Ground& on, double seconds) {
                Mesh mesh = workers.at(on, seconds);
                add_excavator_at_work(mesh, on, path, digging, seconds);
                return mesh;
              }};
}

}  // namespace flagstone::sim
