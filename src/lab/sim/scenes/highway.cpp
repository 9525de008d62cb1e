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
#include "lab/sim/street_shape.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_width = 75;
constexpr int lanes = 3;
constexpr double lane_width = 3.75;
constexpr double line_width = 0.2;  // of the markings
constexpr double dash = 6;          // length of a dash; gaps are twice as long
constexpr double verge = 2;         // level, between shoulder and slope
constexpr double ditch_width = 1.6;
constexpr double ditch_depth = 0.35;

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.2F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface gravel{.semantic = SemanticClass::other_ground, .reflectivity = 0.3F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.3F};
constexpr Surface sign_plate{.semantic = SemanticClass::traffic_sign, .reflectivity = 0.9F};

// The land next to a carriageway. Heights in metres above its edge: negative for an embankment,
// positive for a cutting.
struct Roadside {
  double height, swell, phase;  // mean height, and its variation along the road
  double steepness;             // m/m
  double swell_length;
  double noise_barrier;                 // height; 0 for none
  std::vector<Interval> barrier_reach;  // x
  bool guard_rail;
  [[nodiscard]] double height_at(double x) const noexcept {
    return height + swell * std::sin(2 * std::numbers::pi * x / swell_length + phase);
  }
};

struct Highway {
  Extent extent;
  RoadCurve curve;
  double half_median, inner_shoulder, outer_shoulder;
  double grade, sag;              // height along the road: grade x + sag x^2 / 2
  double cross_fall, bank;        // outward on the straight; upward to the left in the curve
  bool concrete;                  // material of the barrier in the median
  std::array<Roadside, 2> sides;  // indexed by Side
  int own_lane;                   // 0 is next to the median
  std::vector<double> gantries;   // x

  [[nodiscard]] double lanes_begin() const noexcept { return half_median + inner_shoulder; }
  [[nodiscard]] double lanes_end() const noexcept { return lanes_begin() + lanes * lane_width; }
  [[nodiscard]] double paved() const noexcept { return lanes_end() + outer_shoulder; }
  [[nodiscard]] double lane(int index) const noexcept {
    return lanes_begin() + (index + 0.5) * lane_width;
  }
  [[nodiscard]] const Roadside& side(double t) const noexcept { return sides[t > 0]; }
  [[nodiscard]] double height(double x, double t) const noexcept;
  [[nodiscard]] Surface surface(double x, double t) const noexcept;
  // Road coordinates relative to the ground.
  [[nodiscard]] RoadPlace place(const Ground& ground) const {
    return [this, &ground](double x, double t, double z) {
      const double y = curve.at(x).y + t;
      return Vector3{x, y, ground.height(x, y) + z};
    };
  }
};

double Highway::height(double x, double t) const noexcept {
  const double on_road = std::clamp(t, -paved() - verge, paved() + verge);
  const double turned = curve.share(x);
  const double slope = (1 - turned) * (t > 0 ? -cross_fall : cross_fall) + turned * bank;
  const double level = grade * x + sag * x * x / 2 + slope * on_road;
  const double out = std::abs(t) - paved() - verge;
  if (out < 0) return level;
  const double high = side(t).height_at(x);
  if (high < 0) return level + std::max(high, -out * side(t).steepness);
  const double ditch = std::max(0.0, 1 - std::abs(2 * out / ditch_width - 1));
  const double rise = std::max(0.0, out - ditch_width) * side(t).steepness;
  return level - ditch_depth * ditch + std::min(high, rise);
}

Surface Highway::surface(double x, double t) const noexcept {
  const double out = std::abs(t);
  if (out < half_median) return gravel;
  if (out > paved()) return grass;
  for (int line = 0; line <= lanes; ++line) {
    const double from_line = out - lanes_begin() - line * lane_width;
    if (std::abs(from_line) > line_width / 2) continue;
    const bool solid = line == 0 || line == lanes;
    const double period = 3 * dash;
    return solid || x - period * std::floor(x / period) < dash ? paint : asphalt;
  }
  return asphalt;
}

// Barriers and gantries are this many stretches apart.
constexpr std::size_t furniture_period = 5;

std::vector<double> repeated(double x, const Extent& extent) {
  std::vector<double> all;
  for (std::size_t i = 0; i < extent.stretches; i += furniture_period) {
    all.push_back(x + static_cast<double>(i) * stretch_length);
  }
  return all;
}

Roadside draw_side(const Extent& extent, Random& random) {
  const bool barrier = random.chance(0.4);
  const double begin = random.uniform(-120, -10);
  const double drawn = random.uniform(-1, 1);
  Roadside side{.height = 6 * drawn,
                .swell = random.uniform(0, 2),
                .phase = random.uniform(0, 2 * std::numbers::pi),
                .steepness = random.uniform(0.35, 0.65),
                .swell_length = extent.fitted_length(180),
                .noise_barrier = barrier ? random.uniform(2.5, 4.5) : 0,
                .barrier_reach = {},
                .guard_rail = false};
  const double length = random.uniform(60, 160);
  for (const double x : repeated(begin, extent)) side.barrier_reach.push_back({x, x + length});
  side.guard_rail = drawn < 0 || random.chance(0.4);
  return side;
}

Highway draw_highway(const Extent& extent, Random& random) {
  constexpr double half_length = 200;  // of the curve, metres
  const double turn = random.chance(0.5) ? 1 : -1;
  const double curvature = turn / random.uniform(600, 1400);
  Highway road{.extent = extent,
               .curve = {half_length, curvature, random.uniform(-120, 60), random.uniform(60, 120)},
               .half_median = random.uniform(1.2, 2.2),
               .inner_shoulder = random.uniform(0.75, 1.1),
               .outer_shoulder = random.uniform(2.3, 3),
               .grade = random.uniform(-0.04, 0.04),
               .sag = random.uniform(-2.5e-4, 2.5e-4),
               .cross_fall = 0.025,
               .bank = -turn * random.uniform(0.03, 0.07),
               .concrete = random.chance(0.5),
               .sides = {draw_side(extent, random), draw_side(extent, random)},
               .own_lane = static_cast<int>(random.uniform(0, lanes)),
               .gantries = repeated(random.uniform(-30, 60), extent)};
  if (extent.is_long()) {  // its Alignment has the curves and grades
    constexpr double never = 1e9;
    road.curve = {half_length, 0, never, 1};
    road.grade = 0;
    road.sag = 0;
  }
  return road;
}

Ground make_highway(const Highway& highway) {
  GroundPlan plan{.x = {},
                  .t = {},
                  .offset = [&](double x) { return highway.curve.at(x).y; },
                  .height = [&](double x, double t) { return highway.height(x, t); },
                  .surface = [&](double x, double t) { return highway.surface(x, t); },
                  .closed = highway.extent.closed};
  const Interval all = highway.extent.reach(164);
  add_lines(plan.x, all.low, all.high, 2);  // a divisor of the dash length
  std::vector<double> outward;
  add_lines(outward, 0, highway.half_median, 1);
  add_lines(outward, highway.half_median, highway.paved(), 1);
  for (int line = 0; line <= lanes; ++line) {
    const double middle = highway.lanes_begin() + line * lane_width;
    outward.push_back(middle - line_width / 2);
    outward.push_back(middle + line_width / 2);
  }
  const double slope = highway.paved() + verge;
  add_lines(outward, highway.paved(), slope, 1);
  add_lines(outward, slope, slope + ditch_width, ditch_width / 4);
  add_lines(outward, slope + ditch_width, slope + 22, 0.5);
  add_lines(outward, slope + 22, half_width, 2);
  for (const double out : outward) {
    plan.t.push_back(out);
    plan.t.push_back(-out);
  }
  finish_lines(plan.t);
  return cut_ground(std::move(plan));
}

// A gantry over one carriageway, between the median and the verge.
void add_gantry(Mesh& mesh, const Highway& highway, double x, double side, const RoadPlace& place,
                Random& random) {
  const double far = highway.paved() + 1.3;
  const double low = random.uniform(5.8, 6.4);
  for (const double out : {0.0, far}) {
    const double t = side * out;
    add_beam(mesh, {.t = {t - 0.2, t + 0.2}, .z = {-0.3, low + 1.2}}, {x - 0.2, x + 0.2}, 1, place,
             steel);
  }
  // Straight between the two posts.
  const Vector3 one = place(x, 0, low);
  const Vector3 other = place(x, side * far, low);
  const double level = std::max(one.z, other.z);
  const Frame frame = upright_frame({one.x, one.y, level}, 0);
  const double reach = side * far;
  for (const double z : {0.0, 0.9}) {
    add_box(mesh, frame,
            {.low = {-0.3, std::min(0.0, reach), z}, .high = {0.3, std::max(0.0, reach), z + 0.2}},
            steel);
  }
  for (int lane = 0; lane < lanes; ++lane) {
    if (!random.chance(0.75)) continue;
    const double t = side * highway.lane(lane);
    const double half = random.uniform(0.8, 1.6);
    const double facing = side < 0 ? -0.35 : 0.35;  // towards oncoming traffic
    add_box(mesh, frame,
            {.low = {facing - 0.04, t - half, -0.3}, .high = {facing + 0.04, t + half, 1.7}},
            sign_plate);
  }
}

void line_road(Mesh& mesh, const Highway& highway, const RoadPlace& place, const Stretch& stretch,
               Random& random) {
  const Interval all = stretch.reach(159);
  if (highway.concrete) {
    add_concrete_barrier(mesh, 0, all, place);
  } else {
    for (const double t : {-0.4, 0.4}) add_guard_rail(mesh, t, all, place);
  }
  for (const Side which : {Side::right, Side::left}) {
    const Roadside& side = highway.sides[static_cast<std::size_t>(which)];
    const double edge = highway.paved();
    if (side.guard_rail) add_guard_rail(mesh, sign(which) * (edge + 0.5), all, place);
    if (side.noise_barrier > 0) {
      for (const Interval& barrier : side.barrier_reach) {
        const Interval here{std::max(barrier.low, all.low), std::min(barrier.high, all.high)};
        if (here.low >= here.high) continue;
        add_noise_barrier(mesh, sign(which) * (edge + 1.8), side.noise_barrier, here, place);
      }
    }
    for (double x = all.low; x < all.high; x += 50) {
      const double t = sign(which) * (edge + 0.9);
      constexpr Surface post{.semantic = SemanticClass::pole, .reflectivity = 0.6F};
      add_beam(mesh, {.t = {t - 0.06, t + 0.06}, .z = {-0.2, 1.05}}, {x - 0.06, x + 0.06}, 1, place,
               post);
    }
    for (const double gantry : highway.gantries) {
      if (gantry < all.low || gantry >= all.high) continue;
      if (which == Side::right || random.chance(0.5)) {
        add_gantry(mesh, highway, gantry, sign(which), place, random);
      }
    }
  }
}

void plant_slopes(Mesh& mesh, const Highway& highway, const Ground& ground, const Stretch& stretch,
                  Random& random) {
  const Interval row = stretch.reach(94);
  const auto scatter = [&](int per_260_metres, double from_edge, double to_edge, auto plant) {
    const int count = count_of(per_260_metres, 260, row);
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(row.low, row.high);
      const double out = highway.paved() + random.uniform(from_edge, to_edge);
      plant(mesh, ground, x, highway.curve.at(x).y + (random.chance(0.5) ? out : -out), random);
    }
  };
  scatter(30, 9, 45, add_tree);
  scatter(70, 3.5, 30, add_bush);
  scatter(25, 3, 20, add_ground_cover);
  scatter(900, 0.2, 20, add_tuft);
}

Traffic send_traffic(const Highway& highway, const std::vector<Stop>& route, Random& random) {
  const Path middle = [curve = highway.curve](double x) { return curve.at(x); };
  Traffic traffic(route, highway.extent.view());
  for (const double side : {-1.0, 1.0}) {
    for (int lane = 0; lane < lanes; ++lane) {
      const double trucks = lane == lanes - 1 ? 0.6 : lane == 1 ? 0.2 : 0;
      // Slow next to the sensor, faster towards the median, unrestricted on the other carriageway.
      double speed = side > 0 ? -random.uniform(20, 30) : own_speed;
      double t = side * highway.lane(lane);
      if (side < 0 && lane != highway.own_lane) {
        const int inward = highway.own_lane - lane;
        speed = inward > 0 ? own_speed + random.uniform(2, 10) : own_speed - random.uniform(0, 4);
        if (std::abs(inward) == 1) t += 0.52 * inward;  // keeps clear of the lane of the sensor
      }
      traffic.fill(
          {.path = middle,
           .t = t,
           .speed = speed,
           .x = {highway.extent.run(124).low, highway.extent.run(144).high},
           .gap = {10, 55}},
          [trucks](Random& draw) { return draw.chance(trucks) ? RoadUser::truck : RoadUser::car; },
          random);
    }
  }
  return traffic;
}

Mesh furnish_highway(const Highway& highway, const Ground& ground, const Stretch& stretch,
                     Random random) {
  Mesh mesh;
  line_road(mesh, highway, highway.place(ground), stretch, random);
  plant_slopes(mesh, highway, ground, stretch, random);
  return mesh;
}

}  // namespace

Landscape highway(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  Highway road = draw_highway(extent, random);
  std::vector<Stop> route = wander_along(
      [&](double x) {
        Stop stop = road.curve.at(x);
        stop.y -= road.lane(road.own_lane);
        return stop;
      },
      random, extent);
  Traffic traffic = send_traffic(road, route, random);
  Ground ground = make_highway(road);
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish =
              [road = std::move(road), random](const Ground& on, const Stretch& stretch) {
                return furnish_highway(road, on, stretch, stretch.stream(random));
              },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
