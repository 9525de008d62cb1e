// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/buildings.hpp"
#include "lab/sim/furniture.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street_shape.hpp"
#include "lab/sim/traffic.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double furniture_row = 0.6;  // metres from the kerb
constexpr double walk_begin = 2.4;     // metres from the kerb, behind shelters and trees

StreetSide draw_side(Random& random) {
  return {.parking_width = random.chance(0.6) ? random.uniform(2.1, 2.3) : 0,
          .kerb_height = random.uniform(0.1, 0.16),
          .sidewalk_width = random.uniform(3.4, 5),
          .land_slope = 0,
          .bank_height = 0,
          .driveways = {}};
}

StreetShape draw_shape(const Extent& extent, Random& random) {
  StreetShape shape{
      .half_width = random.uniform(3.6, 4.3),
      .land_width = 16,
      .grade = random.uniform(-0.03, 0.03),
      .grade_changes = {{.change = random.uniform(-0.05, 0.05), .x = random.uniform(-30, 40)}},
      .bend_amplitude = random.uniform(-4, 4),
      .crown = random.uniform(0.05, 0.11),
      .cross_fall = random.uniform(-0.012, 0.012),
      .sides = {draw_side(random), draw_side(random)},
      .undulations = {},
      .crossings = {},
      .paved_land = true};
  const Interval reach = extent.reach(44, 8);
  for (double x = random.uniform(reach.low + 10, reach.low + 40); x < reach.high;
       x += random.uniform(35, 60)) {
    shape.crossings.push_back(std::round(x));
  }
  shape.extend(extent);
  return shape;
}

struct Town {
  Extent extent;
  StreetShape shape;
  std::array<std::vector<double>, 2> bus_stops;  // x, indexed by Side

  [[nodiscard]] bool at_crossing(double x, double margin) const {
    return std::ranges::any_of(shape.crossings, [&](double crossing) {
      return std::abs(x - crossing) < crossing_width / 2 + margin;
    });
  }
  [[nodiscard]] bool at_bus_stop(Side side, double x, double margin) const {
    return std::ranges::any_of(bus_stops[static_cast<std::size_t>(side)],
                               [&](double stop) { return std::abs(x - stop) < margin; });
  }
  [[nodiscard]] double y_at(double x, Side side, double out) const {
    return shape.centre_line(x) + sign(side) * out;
  }
  // An upright frame on the ground, `out` metres from the centre line.
  [[nodiscard]] Frame upright(const Ground& ground, double x, Side side, double out,
                              double turn) const {
    const double y = y_at(x, side, out);
    return upright_frame({x, y, ground.height(x, y)}, shape.heading(x) + turn);
  }
  // An upright frame that faces the carriageway.
  [[nodiscard]] Frame facing_road(const Ground& ground, double x, Side side, double out) const {
    return upright(ground, x, side, out, side == Side::left ? -half_turn / 2 : half_turn / 2);
  }
};

void build_row(Mesh& mesh, const Town& town, const Ground& ground, Side side,
               const Stretch& stretch, Random& random) {
  const Interval row = stretch.reach(68, 3);
  double x = row.low + random.uniform(0, 5);
  while (x < row.high) {
    const TerraceHouse house{.width = random.uniform(6, 13),
                             .depth = random.uniform(9, 13),
                             .storeys = 2 + static_cast<int>(random.uniform(0, 4)),
                             .shop = random.chance(0.7)};
    const double turn = side == Side::left ? 0 : half_turn;
    const double middle = x + house.width / 2;
    add_terrace_house(mesh,
                      town.upright(ground, middle, side, town.shape.land_begin(side) + 0.1, turn),
                      house, random);
    x += house.width + (random.chance(0.12) ? random.uniform(3, 9) : 0.0);
  }
}

void park_cars(Mesh& mesh, const Town& town, const Ground& ground, Side side,
               const Stretch& stretch, Random& random) {
  const double width = town.shape.side(side).parking_width;
  if (width == 0) return;
  const Interval row = stretch.reach(44, 0.5 * longest_car);
  for (double x = row.low; x < row.high; x += longest_car + random.uniform(0.6, 1.6)) {
    if (!random.chance(0.8) || town.at_crossing(x, 3.2) || town.at_bus_stop(side, x, 12)) continue;
    const double y = town.y_at(x, side, town.shape.half_width + width / 2);
    const double turn = side == Side::left ? half_turn : 0;
    add_car(mesh, frame_on_wheels(ground, x, y, town.shape.heading(x) + turn, 2.6, 1.5), random);
  }
}

void line_kerb(Mesh& mesh, const Town& town, const Ground& ground, Side side, double path,
               const Stretch& stretch, Random& random) {
  const double out = town.shape.sidewalk_begin(side) + furniture_row;
  const bool room_for_crowns = std::abs(sign(side) * out - path) > 3.4;
  const Interval row = stretch.reach(59, 1.5);
  for (double x = row.low + random.uniform(0, 5); x < row.high; x += random.uniform(3, 9)) {
    if (town.at_crossing(x, 1.5) || town.at_bus_stop(side, x, 4)) continue;
    const double drawn = random.uniform();
    if (drawn < 0.2) {
      add_lamp_post(mesh, town.facing_road(ground, x, side, out));
    } else if (drawn < 0.3) {
      const double facing = side == Side::right ? half_turn : 0;
      add_traffic_sign(mesh, town.upright(ground, x, side, out, facing));
    } else if (drawn < 0.5 && room_for_crowns) {
      add_tree(mesh, ground, x, town.y_at(x, side, out), random);
    } else if (drawn < 0.6) {
      add_bin(mesh, town.upright(ground, x, side, out, 0));
    } else if (drawn < 0.7) {
      add_bench(mesh, town.facing_road(ground, x, side, out));
    } else if (drawn < 0.85) {
      for (const double post : {-1.5, 0.0, 1.5}) {
        add_bollard(mesh, town.upright(ground, x + post, side, out, 0));
      }
    }
  }
  for (const double stop : town.bus_stops[static_cast<std::size_t>(side)]) {
    const Interval here = stretch.reach(59);
    if (stop < here.low || stop >= here.high) continue;
    add_bus_shelter(mesh, town.facing_road(ground, stop, side, out + 1.5));
  }
}

Mesh furnish_town(const Town& town, const Ground& ground, double path, const Stretch& stretch,
                  Random random) {
  Mesh mesh;
  for (const Side side : {Side::right, Side::left}) {
    build_row(mesh, town, ground, side, stretch, random);
    park_cars(mesh, town, ground, side, stretch, random);
    line_kerb(mesh, town, ground, side, path, stretch, random);
  }
  return mesh;
}

RoadUser draw_vehicle(Random& random) {
  const double drawn = random.uniform();
  if (drawn < 0.66) return RoadUser::car;
  if (drawn < 0.8) return RoadUser::bus;
  return drawn < 0.9 ? RoadUser::truck : RoadUser::cyclist;
}

void send_pedestrians(Traffic& traffic, const Town& town, const Path& centre, Random& random) {
  const StreetShape& shape = town.shape;
  for (const Side side : {Side::right, Side::left}) {
    const double begin = shape.sidewalk_begin(side);
    const Interval walked = town.extent.run(39);
    const int walkers = count_of(36, 150, walked);
    for (int person = 0; person < walkers; ++person) {
      const double out = begin + random.uniform(walk_begin, shape.side(side).sidewalk_width - 0.4);
      const double speed = (random.chance(0.5) ? 1 : -1) * random.uniform(0.8, 1.7);
      traffic.join(
          {.kind = RoadUser::person,
           .at = along(centre, sign(side) * out, random.uniform(walked.low, walked.high), speed),
           .look = random.bits()});
    }
    for (const double stop : town.extent.each_lap(town.bus_stops[static_cast<std::size_t>(side)])) {
      for (int waiting = 0; waiting < 4; ++waiting) {
        const double x = stop + random.uniform(-1.7, 1.7);
        const double out = begin + random.uniform(0.5, 1.3);
        traffic.join(
            {.kind = RoadUser::person,
             .at = straight(
                 {.x = x, .y = town.y_at(x, side, out), .yaw = random.uniform(0, 2 * half_turn)}, 0,
                 0),
             .look = random.bits()});
      }
    }
    for (const double crossing : town.extent.each_lap(shape.crossings)) {
      for (int person = 0; person < 3; ++person) {
        const double x = crossing + random.uniform(-1.3, 1.3);
        const double out = shape.kerb(side) + random.uniform(-6, 2.2);
        const Side other = side == Side::left ? Side::right : Side::left;
        traffic.join(
            {.kind = RoadUser::person,
             .at = straight(
                 {.x = x, .y = town.y_at(x, side, out), .yaw = -sign(side) * half_turn / 2},
                 random.uniform(0.6, 1), out + shape.kerb(other) + 1.5,
                 arrival_at(town.extent, crossing)),
             .look = random.bits()});
      }
    }
  }
}

Traffic send_traffic(const Town& town, const std::vector<Stop>& route, double path,
                     Random& random) {
  const StreetShape& shape = town.shape;
  const Path centre = [shape](double x) {
    return Stop{.x = x, .y = shape.centre_line(x), .yaw = shape.heading(x)};
  };
  Traffic traffic(route, town.extent.view());
  traffic.fill(
      {.path = centre, .t = path, .speed = own_speed, .x = town.extent.run(54), .gap = {8, 35}},
      draw_vehicle, random);
  traffic.fill({.path = centre,
                .t = -path,
                .speed = random.uniform(-12, -6),
                .x = town.extent.run(64),
                .gap = {8, 30}},
               draw_vehicle, random);
  send_pedestrians(traffic, town, centre, random);
  return traffic;
}

}  // namespace

Landscape urban_street(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  Town town{.extent = extent, .shape = draw_shape(extent, random), .bus_stops = {}};
  constexpr std::size_t stretches_per_stop = 4;
  for (std::vector<double>& stops : town.bus_stops) {
    for (std::size_t i = 0; i < extent.stretches; i += stretches_per_stop) {
      const Interval x = extent.stretch(i).x;
      double stop = 0;
      do stop = random.uniform(x.low + 1, x.high + 9);
      while (town.at_crossing(stop, 8));
      stops.push_back(stop);
    }
  }
  const double path = -town.shape.half_width / 2;
  std::vector<Stop> route = wander_along(
      [&](double x) {
        return Stop{.x = x, .y = town.shape.centre_line(x) + path, .yaw = town.shape.heading(x)};
      },
      random, extent);
  Traffic traffic = send_traffic(town, route, path, random);
  Ground ground = make_ground(town.shape);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish =
              [town = std::move(town), path, random](const Ground& on, const Stretch& stretch) {
                return furnish_town(town, on, path, stretch, stretch.stream(random));
              },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
