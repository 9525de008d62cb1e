// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/crossroads_shape.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street_furniture.hpp"
#include "lab/sim/terrace_house.hpp"
#include "lab/sim/town_furniture.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_turn = std::numbers::pi;

// The middle of the lane on either side of a road's middle.
double lane_of(const CrossroadsShape::Road& road) noexcept {
  const double begin = road.island.high > 0 ? CrossroadsShape::island_half_width : 0;
  return (begin + road.half_width) / 2;
}

// Puts things on a junction. Signs say in which quadrant: +1 or -1 along x and along y.
class Furnisher {
 public:
  Furnisher(const CrossroadsShape& shape, const Ground& ground, Random& random)
      : shape_(shape), ground_(ground), random_(random) {
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        const bool lawn = shape.lawn[CrossroadsShape::quadrant(sx, sy)];
        if (lawn) {
          plant_park(sx, sy);
        } else {
          build_rows(sx, sy);
        }
        plant_bed(sx, sy);
        line_kerbs(sx, sy);
        put_up_lights(sx, sy);
      }
      plant_island(sx);
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] Frame upright(double x, double y, double yaw) const {
    return upright_frame({x, y, ground_.height(x, y)}, yaw);
  }

  TerraceHouse draw_house() {
    return {.width = random_.uniform(8, 14),
            .depth = 11,
            .storeys = 2 + static_cast<int>(random_.uniform(0, 4)),
            .shop = random_.chance(0.6)};
  }

  // Houses along both roads from the corner on; a house's y axis points into it.
  void build_rows(double sx, double sy) {
    const double behind = shape_.sidewalk + 0.3;
    const double front_y = shape_.own.half_width + behind;
    const double front_x = shape_.side.half_width + behind;
    for (double x = front_x; x < 88;) {
      const TerraceHouse house = draw_house();
      add_terrace_house(mesh_,
                        upright(sx * (x + house.width / 2), sy * front_y, sy > 0 ? 0 : half_turn),
                        house, random_);
      x += house.width;
    }
    for (double y = front_y + 11.5; y < 55;) {
      const TerraceHouse house = draw_house();
      add_terrace_house(mesh_,
                        upright(sx * front_x, sy * (y + house.width / 2), -sx * half_turn / 2),
                        house, random_);
      y += house.width;
    }
  }

  void plant_park(double sx, double sy) {
    const double begin_x = shape_.side.half_width + shape_.sidewalk + 1;
    const double begin_y = shape_.own.half_width + shape_.sidewalk + 1;
    const auto scatter = [&](int count, double margin, auto plant) {
      for (int i = 0; i < count; ++i) {
        plant(mesh_, ground_, sx * random_.uniform(begin_x + margin, 80),
              sy * random_.uniform(begin_y + margin, 50), random_);
      }
    };
    scatter(9, 2, add_tree);
    scatter(18, 1, add_bush);
    scatter(300, 0, add_tuft);
    scatter(10, 1, add_ground_cover);
    if (random_.chance(0.5)) {
      add_hedge(mesh_, ground_,
                {.x0 = sx * (begin_x + 4), .y0 = sy * begin_y, .x1 = sx * 60, .y1 = sy * begin_y},
                random_);
    }
  }

  void plant_bed(double sx, double sy) {
    if (shape_.bed_heights[CrossroadsShape::quadrant(sx, sy)] == 0) return;
    const Interval x = shape_.bed_x;
    const Interval y = shape_.bed_y;
    constexpr double margin = 0.3;
    for (int tuft = 0; tuft < 40; ++tuft) {
      add_tuft(mesh_, ground_, sx * random_.uniform(x.low + margin, x.high - margin),
               sy * random_.uniform(y.low + margin, y.high - margin), random_);
    }
  }

  void plant_island(double sx) {
    const Interval reach = shape_.own.island;
    if (reach.high == 0) return;
    for (int tuft = 0; tuft < 25; ++tuft) {
      add_tuft(mesh_, ground_, sx * random_.uniform(reach.low + 0.3, reach.high - 0.3),
               random_.uniform(-0.6, 0.6), random_);
    }
    add_traffic_sign(mesh_, upright(sx * (reach.low + 0.4), 0, sx > 0 ? 0 : half_turn));
  }

  void line_kerbs(double sx, double sy) {
    // Bollards around the corner, where the kerb is round.
    const double middle_x = shape_.side.half_width + shape_.corner;
    const double middle_y = shape_.own.half_width + shape_.corner;
    const double radius = shape_.corner - 0.5;
    for (double angle = 0.15; angle < half_turn / 2; angle += 1.6 / radius) {
      add_bollard(mesh_, upright(sx * (middle_x - radius * std::cos(angle)),
                                 sy * (middle_y - radius * std::sin(angle)), 0));
    }
    const double y = sy * (shape_.own.half_width + 0.6);
    const double to_road = -sy * half_turn / 2;
    for (double x = shape_.bed_x.high + random_.uniform(1, 6); x < 90;
         x += random_.uniform(5, 14)) {
      const double drawn = random_.uniform();
      if (drawn < 0.4) {
        add_lamp_post(mesh_, upright(sx * x, y, to_road));
      } else if (drawn < 0.6) {
        add_bin(mesh_, upright(sx * x, y, 0));
      } else if (drawn < 0.8) {
        add_bench(mesh_, upright(sx * x, y, to_road));
      }
    }
  }

  // Before the crossings, on the right of who comes along each road.
  void put_up_lights(double sx, double sy) {
    constexpr double before = 0.7;          // the crossing
    const bool right_of_own = sx * sy > 0;  // who comes from x < 0 keeps to y < 0
    if (right_of_own) {
      const double x =
          shape_.crossing_begin(shape_.side) + CrossroadsShape::crossing_width + before;
      const double arm = random_.chance(0.5) ? lane_of(shape_.own) : 0;
      add_traffic_light(
          mesh_, upright(sx * x, sy * (shape_.own.half_width + 0.5), sx > 0 ? 0 : half_turn), -arm);
    } else {
      const double y = shape_.crossing_begin(shape_.own) + CrossroadsShape::crossing_width + before;
      add_traffic_light(
          mesh_, upright(sx * (shape_.side.half_width + 0.5), sy * y, sy * half_turn / 2), 0);
    }
  }

  const CrossroadsShape& shape_;
  const Ground& ground_;
  Random& random_;
  Mesh mesh_;
};

RoadUser draw_vehicle(Random& random) {
  const double drawn = random.uniform();
  if (drawn < 0.7) return RoadUser::car;
  if (drawn < 0.8) return RoadUser::truck;
  return drawn < 0.9 ? RoadUser::bus : RoadUser::cyclist;
}

// On the side road: waiting at the crossing, or on the way over the junction while that is free.
void send_crossing_traffic(Traffic& traffic, const CrossroadsShape& shape, Random& random) {
  for (const double from : {-1.0, 1.0}) {
    const double x = -from * lane_of(shape.side);
    const double yaw = -from * half_turn / 2;
    const double stop_line = shape.crossing_begin(shape.own) + CrossroadsShape::crossing_width + 1;
    const bool waits = random.chance(0.5);
    double y = waits ? stop_line : -60;
    while (y < 65) {
      const RoadUser kind = draw_vehicle(random);
      const double half = kind == RoadUser::truck || kind == RoadUser::bus ? 7.8 : 2.7;
      y += half;
      traffic.join({.kind = kind,
                    .at = straight({.x = x, .y = from * y, .yaw = yaw}, waits ? 0 : 9, 120),
                    .look = random.bits()});
      y += half + (waits ? random.uniform(1, 2) : random.uniform(6, 20));
    }
  }
}

void send_pedestrians(Traffic& traffic, const CrossroadsShape& shape, Random& random) {
  const auto walk = [&](double x, double y, double yaw, double way) {
    traffic.join({.kind = RoadUser::person,
                  .at = straight({.x = x, .y = y, .yaw = yaw}, random.uniform(0.7, 1.6), way),
                  .look = random.bits()});
  };
  const auto either = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
  const auto on_crossing = [&](const CrossroadsShape::Road& other) {
    return either() * (shape.crossing_begin(other) + random.uniform(0.4, 3.1));
  };
  constexpr double on_sidewalk = 1.5;
  for (int person = 0; person < 14; ++person) {
    const double sign = either();
    const double side = sign * (shape.side.half_width + on_sidewalk);
    const double own = sign * (shape.own.half_width + on_sidewalk);
    walk(random.uniform(-1, 1) * side, on_crossing(shape.own), sign > 0 ? half_turn : 0,
         2 * std::abs(side));
    walk(on_crossing(shape.side), random.uniform(0, 1) * own, -sign * half_turn / 2,
         std::abs(own) + std::abs(own) * 0.9);
  }
  // Along the sidewalks, as far as the crossing.
  for (int person = 0; person < 50; ++person) {
    const double from = shape.crossing_begin(shape.side);
    const double x = from + random.uniform(0, 60);
    const double sx = either();
    const double y = either() * (shape.own.half_width + shape.sidewalk - random.uniform(0.3, 0.6));
    const bool inward = random.chance(0.5);
    walk(sx * x, y, (sx > 0) == inward ? half_turn : 0, inward ? x - from : 20);
  }
}

Traffic send_traffic(const CrossroadsShape& shape, const std::vector<Stop>& route, Random& random) {
  const Path middle = [](double x) { return Stop{.x = x, .y = 0, .yaw = 0}; };
  const double lane = lane_of(shape.own);
  Traffic traffic(route);
  traffic.fill({.path = middle, .t = -lane, .speed = own_speed, .x = {-85, 85}, .gap = {12, 40}},
               draw_vehicle, random);
  traffic.fill(
      {.path = middle, .t = lane, .speed = random.uniform(-11, -7), .x = {-90, 90}, .gap = {8, 30}},
      draw_vehicle, random);
  send_crossing_traffic(traffic, shape, random);
  send_pedestrians(traffic, shape, random);
  return traffic;
}

}  // namespace

Landscape crossroads(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  const CrossroadsShape shape = draw_crossroads(random);
  const double lane = -lane_of(shape.own);
  std::vector<Stop> route =
      wander_along([&](double x) { return Stop{.x = x, .y = lane, .yaw = 0}; }, random);
  Traffic traffic = send_traffic(shape, route, random);
  return {.ground = make_ground(shape),
          .route = std::move(route),
          .furnish =
              [shape, random](const Ground& on) {
                Random own = random;
                return Furnisher(shape, on, own).take();
              },
          .moving = [traffic = std::move(traffic)](const Ground& on,
                                                   int stop) { return traffic.at(on, stop); }};
}

}  // namespace flagstone::sim
