// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double half_length = 58;  // to the end walls, metres
constexpr double half_aisle = 3.3;  // from the path of the sensor to the bays
constexpr double bay_depth = 5.2;
constexpr double bay_width = 2.5;
constexpr double column_pitch = 3 * bay_width;
constexpr double bay_end = half_aisle + bay_depth;
constexpr double second_aisle = bay_end + bay_depth;  // its start on a wide side
constexpr double ramp_wall = 0.25;                    // thickness
constexpr double line_width = 0.1;
constexpr double transition = 3;  // at each end of the ramp, with half its grade
constexpr double wide = second_aisle + 2 * half_aisle + bay_depth;

constexpr Surface lane{.semantic = SemanticClass::road, .reflectivity = 0.3F, .mirror = 0.05F};
constexpr Surface bay{.semantic = SemanticClass::parking, .reflectivity = 0.32F, .mirror = 0.05F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface concrete{.semantic = SemanticClass::building, .reflectivity = 0.35F};
constexpr Surface pipe{.semantic = SemanticClass::building, .reflectivity = 0.5F};

// A lower storey, a straight ramp and an upper storey. `u` points up the ramp, along x or -x; t is
// measured to the left of x, from the middle of the aisle and the ramp.
struct CarPark {
  double up;           // +1 if u points along x, -1 if along -x
  double clear, slab;  // height below the ceiling, and its thickness
  double grade;        // of the ramp, m/m
  double foot;         // u at which the ramp begins
  double half_ramp;    // half of the width between its walls
  double drainage;     // slope of the floors away from the aisle, m/m
  bool enclosed;       // walls next to the ramp up to the ceiling; otherwise parapets and a void
  bool parapets;       // parapets around the storeys; otherwise walls up to the ceiling
  std::array<double, 2> reach;  // distances of the right and left walls

  [[nodiscard]] double storey() const noexcept { return clear + slab; }
  [[nodiscard]] double head() const noexcept { return foot + storey() / grade + transition; }
  // Height of the ramp: 0 before it, storey() behind it.
  [[nodiscard]] double ramp_height(double u) const noexcept {
    const auto part = [&](double begin, double end) { return std::clamp(u, begin, end) - begin; };
    return grade * (part(foot, head()) -
                    (part(foot, foot + transition) + part(head() - transition, head())) / 2);
  }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double u = up * x;
    // The ground is discontinuous between the storeys and the ramp; walls hide this.
    const bool on_ramp = std::abs(t) < half_ramp + ramp_wall / 2;
    const double floor = on_ramp ? ramp_height(u) : u < head() ? 0 : storey();
    return floor + drainage * std::max(0.0, std::abs(t) - half_aisle);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = std::abs(t);
    const bool in_bay = out > half_aisle && (out < second_aisle || out > wide - bay_depth);
    if (!in_bay) return lane;
    const double from_line = x - bay_width * std::round(x / bay_width);
    return std::abs(from_line) < line_width / 2 ? paint : bay;
  }
};

CarPark draw_car_park(Random& random) {
  const double right = random.chance(0.6) ? wide : bay_end;
  const double left = right == wide && random.chance(0.5) ? bay_end : wide;
  return {.up = random.chance(0.5) ? 1.0 : -1.0,
          .clear = random.uniform(2.35, 2.8),
          .slab = random.uniform(0.28, 0.4),
          .grade = random.uniform(0.12, 0.15),
          .foot = random.uniform(-24, -4),
          .half_ramp = random.uniform(2.5, 2.9),
          .drainage = random.uniform(-0.006, 0.006),
          .enclosed = random.chance(0.5),
          .parapets = random.chance(0.5),
          .reach = {right, left}};
}

Ground make_car_park(const CarPark& park) {
  constexpr double face = 0.02;  // width of the jumps of the ground, inside walls
  GroundPlan plan{.x = {},
                  .t = {},
                  .offset = [](double) { return 0.0; },
                  .height = [&](double x, double t) { return park.height(x, t); },
                  .surface = [&](double x, double t) { return park.surface(x, t); }};
  const double margin = 1;  // beyond the walls, for lines that are tilted with the vehicle
  add_lines(plan.x, -half_length - margin, half_length + margin, 0.5);
  for (double line = -55; line <= 55; line += bay_width) {
    plan.x.push_back(line - line_width / 2);
    plan.x.push_back(line + line_width / 2);
  }
  plan.x.push_back(park.up * park.head() - face / 2);
  plan.x.push_back(park.up * park.head() + face / 2);
  for (const double end : {park.foot, park.foot + transition, park.head() - transition}) {
    plan.x.push_back(park.up * end);
  }
  add_lines(plan.t, -park.reach[0] - margin, park.reach[1] + margin, 0.6);
  for (const double side : {-1.0, 1.0}) {
    for (const double edge : {half_aisle, second_aisle, wide - bay_depth}) {
      if (edge < park.reach[side > 0]) plan.t.push_back(side * edge);
    }
    const double jump = park.half_ramp + ramp_wall / 2;
    plan.t.push_back(side * (jump - face / 2));
    plan.t.push_back(side * (jump + face / 2));
  }
  finish_lines(plan.x);
  finish_lines(plan.t);
  return cut_ground(std::move(plan));
}

// Builds both storeys in coordinates u and t.
class Builder {
 public:
  Builder(const CarPark& park, const Ground& ground, Random& random)
      : park_(park), ground_(ground), random_(random) {
    enclose();
    wall_ramp();
    roof();
    for (const bool upper : {false, true}) {
      stand_columns(upper);
      park_cars(upper);
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void block(Interval u, Interval t, Interval z, Surface surface = concrete) {
    const double one = park_.up * u.low;
    const double other = park_.up * u.high;
    add_box(mesh_, Frame{},
            {.low = {std::min(one, other), t.low, z.low},
             .high = {std::max(one, other), t.high, z.high}},
            surface);
  }
  [[nodiscard]] double floor(bool upper) const { return upper ? park_.storey() : 0; }
  [[nodiscard]] double ceiling(bool upper) const { return floor(upper) + park_.clear; }
  // Extent of a storey along u.
  [[nodiscard]] Interval reach(bool upper) const {
    return upper ? Interval{park_.head(), half_length} : Interval{-half_length, park_.head()};
  }

  void enclose() {
    constexpr double thick = 0.25;
    constexpr double below = 0.4;
    constexpr double parapet = 1.1;
    const Interval all{-park_.reach[0] - thick, park_.reach[1] + thick};
    block({-half_length - thick, -half_length}, all, {-below, ceiling(false)});
    block({half_length, half_length + thick}, all, {park_.storey() - below, ceiling(true)});
    for (const double side : {-1.0, 1.0}) {
      const double t = side * park_.reach[side > 0];
      const Interval wall{std::min(t, t + side * thick), std::max(t, t + side * thick)};
      for (const bool upper : {false, true}) {
        const double top = park_.parapets ? floor(upper) + parapet : ceiling(upper);
        block(reach(upper), wall, {floor(upper) - below, top});
      }
    }
    // A wall above the ceiling of the lower storey, at the start of the ramp.
    block({park_.foot - thick, park_.foot}, all, {park_.clear, ceiling(true)});
  }

  void wall_ramp() {
    constexpr double half = 0.12;
    constexpr double parapet = 1.05;
    const double top = park_.enclosed ? ceiling(true) : park_.storey() + parapet;
    for (const double side : {-1.0, 1.0}) {
      const double inner = side * park_.half_ramp;
      const double outer = side * (park_.half_ramp + ramp_wall);
      const Interval wall{std::min(inner, outer), std::max(inner, outer)};
      const double end = side * park_.reach[side > 0];
      // A wall at the start of the upper storey next to the ramp.
      block({park_.head() - half, park_.head() + half},
            {std::min(inner, end), std::max(inner, end)}, {-0.3, top});
      if (park_.enclosed) {
        block({park_.foot + 0.5, park_.head()}, wall, {-0.3, top});
        continue;
      }
      for (double u = park_.foot; u < park_.head(); u += 1) {
        const double next = std::min(u + 1, park_.head());
        block({u, next}, wall, {-0.3, park_.ramp_height(next) + parapet});
      }
    }
  }

  // The ceiling of one storey: a slab and beams from column to column.
  void cover(bool upper, Interval u, Interval t) {
    constexpr double deep = 0.2;
    constexpr double half_beam = 0.18;
    const double z = ceiling(upper);
    block(u, t, {z, z + 0.1});
    const double first = column_pitch * std::ceil((u.low + half_beam) / column_pitch);
    for (double at = first; at < u.high - half_beam; at += column_pitch) {
      block({at - half_beam, at + half_beam}, t, {z - deep, z});
    }
    for (const double at : {t.low + 1, t.high - 1}) {
      block(u, {at, at + 0.08}, {z - deep - 0.1, z - deep - 0.02}, pipe);
    }
  }

  void roof() {
    const Interval all{-park_.reach[0], park_.reach[1]};
    cover(false, {-half_length, park_.foot}, all);
    cover(true, {park_.foot, half_length}, all);
    if (!park_.enclosed) return;
    const double ramp_end = park_.half_ramp + ramp_wall;
    cover(false, {park_.foot, park_.head()}, {-park_.reach[0], -ramp_end});
    cover(false, {park_.foot, park_.head()}, {ramp_end, park_.reach[1]});
  }

  void stand_columns(bool upper) {
    constexpr double half = 0.2;
    const Interval u = reach(upper);
    for (double at = -7 * column_pitch; at < half_length; at += column_pitch) {
      if (at < u.low + 1 || at > u.high - 1) continue;
      for (const double side : {-1.0, 1.0}) {
        for (const double out : {half_aisle + 0.9, bay_end, second_aisle - 0.9}) {
          if (out + half > park_.reach[side > 0]) continue;
          const double t = side * out;
          block({at - half, at + half}, {t - half, t + half},
                {floor(upper) - 0.3,
                 ceiling(upper) + (park_.enclosed || upper ? 0 : park_.storey())});
        }
      }
    }
  }

  void park_cars(bool upper) {
    constexpr double half_car = 1.1;
    const double occupied = random_.uniform(0.5, 0.95);
    const Interval u = reach(upper);
    for (double at = -21.5 * bay_width; at < half_length; at += bay_width) {
      if (at < u.low + half_car || at > u.high - half_car) continue;
      for (const double side : {-1.0, 1.0}) {
        for (const double out :
             {half_aisle + bay_depth / 2, bay_end + bay_depth / 2, wide - bay_depth / 2}) {
          if (out > park_.reach[side > 0] || !random_.chance(occupied)) continue;
          const double yaw = (random_.chance(0.5) ? 0.5 : -0.5) * half_turn;
          add_car(mesh_,
                  frame_on_wheels(ground_, park_.up * at, side * out,
                                  yaw + random_.uniform(-0.02, 0.02), 2.6, 1.5),
                  random_);
        }
      }
    }
  }

  const CarPark& park_;
  const Ground& ground_;
  Random& random_;
  Mesh mesh_;
};

Traffic send_traffic(const CarPark& park, const std::vector<Stop>& route, Random& random) {
  const Path middle = [](double x) { return Stop{.x = x, .y = 0, .yaw = 0}; };
  Traffic traffic(route);
  traffic.join({.kind = RoadUser::car,
                .at = along(middle, 0, -half_drive + random.uniform(12, 25), own_speed),
                .look = random.bits()});
  // Traffic along the second aisle of a storey, up to its wall.
  for (const double side : {-1.0, 1.0}) {
    if (park.reach[side > 0] < wide) continue;
    const double t = side * (second_aisle + half_aisle);
    for (const bool upper : {false, true}) {
      const double begin = upper ? half_length : -half_length;
      const double from = park.up * (begin + (upper ? -6 : 6));
      const double way = std::abs(park.head() - begin) - 14;
      const double yaw = (park.up > 0) == upper ? half_turn : 0;
      traffic.join({.kind = RoadUser::car,
                    .at = straight({.x = from, .y = t, .yaw = yaw}, random.uniform(2, 5), way),
                    .look = random.bits()});
    }
  }
  for (int person = 0; person < 24; ++person) {
    const double side = random.chance(0.5) ? 1 : -1;
    const double out = park.reach[side > 0] == wide && random.chance(0.5)
                           ? random.uniform(second_aisle + 0.5, second_aisle + 2 * half_aisle - 0.5)
                           : random.uniform(half_aisle - 0.3, half_aisle + 0.1);
    const double x = random.uniform(-50, 50);
    if (std::abs(park.up * x - park.head()) < 16) continue;  // would walk through a wall
    traffic.join({.kind = RoadUser::person,
                  .at = along(middle, side * out, x, random.uniform(-1.5, 1.5)),
                  .look = random.bits()});
  }
  return traffic;
}

}  // namespace

Landscape ramp(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  const CarPark park = draw_car_park(random);
  std::vector<Stop> route =
      wander_along([](double x) { return Stop{.x = x, .y = 0, .yaw = 0}; }, random);
  Traffic traffic = send_traffic(park, route, random);
  return {.ground = make_car_park(park),
          .route = std::move(route),
          .furnish =
              [park, random](const Ground& on, const Stretch& /*whole*/) {
                Random own = random;
                return Builder(park, on, own).take();
              },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
