// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/route.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 120;  // of the ground, metres
constexpr double half_width = 40;
constexpr double face = 0.02;  // of kerbs and of the hidden jump behind walls
constexpr double wall = 0.4;   // thickness
constexpr double line_width = 0.15;
constexpr double dash = 6;      // of the middle line, with equal gaps
constexpr double cutting = 45;  // length over which the land rises to the portal

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.2F};
constexpr Surface wet{.semantic = SemanticClass::road, .reflectivity = 0.07F, .mirror = 0.7F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface walkway{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface lining{.semantic = SemanticClass::other_structure, .reflectivity = 0.4F};
constexpr Surface concrete{.semantic = SemanticClass::other_structure, .reflectivity = 0.35F};
constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.25F};
constexpr Surface cabinet{.semantic = SemanticClass::other_object, .reflectivity = 0.4F};
constexpr Surface plate{.semantic = SemanticClass::traffic_sign, .reflectivity = 0.8F};

struct Patch {
  double x, t, along, across;  // middle and half axes of an ellipse
  [[nodiscard]] bool covers(double px, double pt) const noexcept {
    return std::hypot((px - x) / along, (pt - t) / across) < 1;
  }
};

// A road along x that enters a hill at `portal`. Heights in metres above the middle of the road.
struct Tunnel {
  RoadCurve curve;
  double inward;  // +1 if the road enters the hill in the direction of x, -1 if it leaves it
  double portal;  // x
  double half_road, walk;  // widths
  double kerb;
  double grade, sag;  // height along the road: grade x + sag x^2 / 2
  double cross_fall;  // to the left, m/m
  bool arched;
  double height;  // of the ceiling, or of the middle of an arch
  double hill;    // height of the land above the portal
  std::vector<Patch> puddles;

  // Distance from the middle of the road to the walls.
  [[nodiscard]] double half() const noexcept { return half_road + face + walk; }
  [[nodiscard]] double level(double x) const noexcept { return grade * x + sag * x * x / 2; }
  // Height of the land behind the walls above the road.
  [[nodiscard]] double land(double x) const noexcept {
    const double near = std::clamp(1 + inward * (x - portal) / cutting, 0.0, 1.0);
    return kerb + (hill - kerb) * near * near * (3 - 2 * near);
  }
  [[nodiscard]] double ground(double x, double t) const noexcept {
    const double out = std::abs(t);
    const double jump = half() + wall / 2;
    if (out > jump) return level(x) + land(x) + 0.15 * (land(x) - kerb) / hill * (out - jump);
    return level(x) + cross_fall * std::clamp(t, -half_road, half_road) +
           kerb * std::clamp((out - half_road) / face, 0.0, 1.0);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = std::abs(t);
    if (out > half() + wall / 2) return grass;
    if (out > half_road) return walkway;
    const bool dashed = x - 2 * dash * std::floor(x / (2 * dash)) < dash;
    const bool at_edge = std::abs(out - half_road + 0.3) < line_width / 2;
    if (at_edge || (out < line_width / 2 && dashed)) return paint;
    const auto covers = [&](const Patch& puddle) { return puddle.covers(x, t); };
    return std::ranges::any_of(puddles, covers) ? wet : asphalt;
  }
  // Outline of the ceiling from wall to wall.
  [[nodiscard]] std::vector<OutlinePoint> vault() const;
  // Height of the ceiling at t.
  [[nodiscard]] double ceiling(double t) const noexcept {
    if (!arched) return height;
    const double share = t / half();
    return spring + (height - spring) * std::sqrt(std::max(0.0, 1 - share * share));
  }
  [[nodiscard]] RoadPlace place() const {
    return [this](double x, double t, double z) {
      return Vector3{x, curve.at(x).y + t, level(x) + z};
    };
  }

  static constexpr double spring = 2;  // height at which the arch starts
};

std::vector<OutlinePoint> Tunnel::vault() const {
  constexpr double buried = 0.5;
  std::vector<OutlinePoint> outline{{-half(), -buried}};
  const int pieces = arched ? 16 : 1;
  for (int i = 0; i <= pieces; ++i) {
    const double t = -half() * std::cos(std::numbers::pi * i / pieces);
    outline.push_back({t, ceiling(t)});
  }
  outline.push_back({half(), -buried});
  return outline;
}

Tunnel draw_tunnel(Random& random) {
  const double turn = random.chance(0.5) ? 1 : -1;
  Tunnel tunnel{.curve = {half_length, turn / random.uniform(400, 1500), random.uniform(-100, 20),
                          random.uniform(50, 100)},
                .inward = random.chance(0.5) ? 1.0 : -1.0,
                .portal = random.uniform(-22, 22),
                .half_road = random.uniform(3.9, 4.4),
                .walk = random.uniform(0.8, 1.4),
                .kerb = random.uniform(0.15, 0.4),
                .grade = random.uniform(-0.05, 0.05),
                .sag = random.uniform(-4e-4, 4e-4),
                .cross_fall = random.uniform(-0.03, 0.03),
                .arched = random.chance(0.5),
                .height = 0,
                .hill = random.uniform(6.8, 8.5),
                .puddles = {}};
  tunnel.height = tunnel.arched ? random.uniform(6, 6.7) : random.uniform(5.4, 6);
  for (int puddle = 0; puddle < 14; ++puddle) {
    tunnel.puddles.push_back({.x = random.uniform(-70, 70),
                              .t = random.uniform(-1, 1) * tunnel.half_road,
                              .along = random.uniform(1, 6),
                              .across = random.uniform(0.4, 1.6)});
  }
  return tunnel;
}

Ground make_tunnel(const Tunnel& tunnel) {
  GroundPlan plan{.x = {},
                  .t = {},
                  .offset = [&](double x) { return tunnel.curve.at(x).y; },
                  .height = [&](double x, double t) { return tunnel.ground(x, t); },
                  .surface = [&](double x, double t) { return tunnel.surface(x, t); }};
  add_lines(plan.x, -half_length, half_length, 0.5);
  const double edge = tunnel.half_road;
  const double jump = tunnel.half() + wall / 2;
  std::vector<double> outward{line_width / 2, edge - 0.3 - line_width / 2,
                              edge - 0.3 + line_width / 2};
  add_lines(outward, 0, edge, 0.25);
  add_lines(outward, edge, edge + face, face);
  add_lines(outward, edge + face, jump - face / 2, 0.5);
  add_lines(outward, jump - face / 2, jump + face / 2, face);
  add_lines(outward, jump + face / 2, half_width, 1.5);
  for (const double out : outward) {
    plan.t.push_back(out);
    plan.t.push_back(-out);
  }
  finish_lines(plan.t);
  return cut_ground(std::move(plan));
}

// Ranges of x inside and before the tunnel, up to the ends of the road.
Interval inside(const Tunnel& tunnel) {
  return tunnel.inward > 0 ? Interval{tunnel.portal, half_length}
                           : Interval{-half_length, tunnel.portal};
}
Interval before(const Tunnel& tunnel) {
  const double end = tunnel.portal - tunnel.inward * cutting;
  return {std::min(end, tunnel.portal), std::max(end, tunnel.portal)};
}

void build_shell(Mesh& mesh, const Tunnel& tunnel) {
  const RoadPlace place = tunnel.place();
  const std::vector<OutlinePoint> vault = tunnel.vault();
  add_extrusion(mesh, vault, inside(tunnel), 2, place, lining);

  // The portal: a wall around the end of the vault.
  const double top = tunnel.hill + 1.2;
  const double x = tunnel.portal;
  for (std::size_t i = 1; i + 2 < vault.size(); ++i) {
    mesh.add_quad(place(x, vault[i].t, vault[i].z), place(x, vault[i + 1].t, vault[i + 1].z),
                  place(x, vault[i + 1].t, top), place(x, vault[i].t, top), concrete);
  }
  for (const double side : {-1.0, 1.0}) {
    const double one = side * tunnel.half();
    const double other = side * (tunnel.half() + 7);
    add_beam(mesh, {.t = {std::min(one, other), std::max(one, other)}, .z = {-0.5, top}},
             {std::min(x, x + tunnel.inward * wall), std::max(x, x + tunnel.inward * wall)}, 1,
             place, concrete);
    // The retaining wall of the cutting, higher than the land behind it.
    const Interval reach = before(tunnel);
    for (double at = reach.low; at < reach.high; at += 1.5) {
      const double next = std::min(at + 1.5, reach.high);
      const double high = std::max(tunnel.land(at), tunnel.land(next));
      const double outer = side * (tunnel.half() + wall);
      add_beam(mesh, {.t = {std::min(one, outer), std::max(one, outer)}, .z = {-0.5, high + 0.8}},
               {at, next}, 2, place, concrete);
    }
  }
}

void equip(Mesh& mesh, const Tunnel& tunnel, Random& random) {
  const RoadPlace place = tunnel.place();
  const Interval reach = inside(tunnel);
  constexpr double light_at = 1.3;
  const double lamp = tunnel.ceiling(light_at) - 0.25;
  for (double x = reach.low + 2; x < reach.high - 2; x += 6) {
    for (const double side : {-1.0, 1.0}) {
      const double t = side * light_at;
      add_beam(mesh, {.t = {t - 0.15, t + 0.15}, .z = {lamp, lamp + 0.15}}, {x, x + 1.3}, 2, place,
               steel);
    }
  }
  for (double x = reach.low + random.uniform(6, 20); x < reach.high - 5;
       x += random.uniform(25, 40)) {
    constexpr double radius = 0.42;
    for (const double t : {-0.7, 0.7}) {
      const double z = tunnel.ceiling(0.7 + radius) - radius - 0.15;
      add_cone(mesh, Frame{},
               {.from = place(x, t, z),
                .to = place(x + 3, t, z),
                .radius_from = radius,
                .radius_to = radius,
                .sides = 14},
               steel);
    }
  }
  for (const double side : {-1.0, 1.0}) {
    const auto at_wall = [&](double deep) {
      const double one = side * tunnel.half();
      const double other = side * (tunnel.half() - deep);
      return Interval{std::min(one, other), std::max(one, other)};
    };
    const double floor = tunnel.kerb;
    add_beam(mesh, {.t = at_wall(0.06), .z = {floor + 0.95, floor + 1.02}}, reach, 4, place, steel);
    add_beam(mesh,
             {.t = at_wall(0.3),
              .z = {tunnel.ceiling(tunnel.half() - 0.3) - 0.4,
                    tunnel.ceiling(tunnel.half() - 0.3) - 0.3}},
             reach, 4, place, steel);
    for (double x = reach.low + random.uniform(3, 12); x < reach.high - 2;
         x += random.uniform(12, 25)) {
      if (random.chance(0.5)) {
        add_beam(mesh, {.t = at_wall(0.25), .z = {floor + 0.7, floor + 1.7}}, {x, x + 0.8}, 1,
                 place, cabinet);
      } else {
        add_beam(mesh, {.t = at_wall(0.08), .z = {floor + 1.3, floor + 1.9}}, {x, x + 0.9}, 1,
                 place, plate);
      }
    }
  }
}

// Plants on the land next to the approach.
void plant_land(Mesh& mesh, const Tunnel& tunnel, const Ground& ground, Random& random) {
  const auto scatter = [&](int count, double from_wall, auto plant) {
    for (int i = 0; i < count; ++i) {
      const double x = tunnel.portal - tunnel.inward * random.uniform(2, 85);
      const double out = tunnel.half() + random.uniform(from_wall, 26);
      if (std::abs(x) > half_length - 5) continue;
      plant(mesh, ground, x, tunnel.curve.at(x).y + (random.chance(0.5) ? out : -out), random);
    }
  };
  scatter(26, 4, add_tree);
  scatter(50, 1.8, add_bush);
  scatter(500, 0.6, add_tuft);
  for (int post = 0; post < 4; ++post) {
    const double x = tunnel.portal - tunnel.inward * (cutting + 4 + 12 * post);
    if (std::abs(x) > half_length - 5) continue;
    const double y = tunnel.curve.at(x).y - tunnel.half() - 0.5;
    const Frame frame = upright_frame({x, y, ground.height(x, y)}, std::numbers::pi / 2);
    add_lamp_post(mesh, frame);
  }
}

Traffic send_traffic(const Tunnel& tunnel, const std::vector<Stop>& route, Random& random) {
  const Path middle = [curve = tunnel.curve](double x) { return curve.at(x); };
  const auto draw = [](Random& drawn) {
    return drawn.chance(0.3) ? RoadUser::truck : RoadUser::car;
  };
  const double lane = tunnel.half_road / 2;
  Traffic traffic(route);
  traffic.fill({.path = middle, .t = -lane, .speed = own_speed, .x = {-100, 100}, .gap = {12, 45}},
               draw, random);
  traffic.fill({.path = middle,
                .t = lane + 0.35,
                .speed = random.uniform(-16, -8),
                .x = {-105, 105},
                .gap = {12, 45}},
               draw, random);
  return traffic;
}

Mesh furnish_tunnel(const Tunnel& tunnel, const Ground& ground, Random random) {
  Mesh mesh;
  build_shell(mesh, tunnel);
  equip(mesh, tunnel, random);
  plant_land(mesh, tunnel, ground, random);
  return mesh;
}

}  // namespace

Landscape tunnel(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Tunnel drawn = draw_tunnel(random);
  std::vector<Stop> route = wander_along(
      [&](double x) {
        Stop stop = drawn.curve.at(x);
        stop.y -= drawn.half_road / 2;
        return stop;
      },
      random);
  Traffic traffic = send_traffic(drawn, route, random);
  Ground ground = make_tunnel(drawn);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [drawn = std::move(drawn), random](
                         const Ground& on,
                         const Stretch& /*whole*/) { return furnish_tunnel(drawn, on, random); },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
