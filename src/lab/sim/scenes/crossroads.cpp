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
#include "lab/sim/ground.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {
namespace {

// Two crowned roads that cross at the origin, one along x and one along y. Lengths in metres;
// opposite arms are equal. In a long environment, further roads of the same shape cross the first.
struct CrossroadsShape {
  static constexpr double half_length = 105;  // of the road along x
  static constexpr std::size_t period = 3;    // stretches from one junction to the next
  static constexpr double half_width = 70;    // of the road along y
  static constexpr double crossing_width = 3.5;
  static constexpr double island_half_width = 0.9;

  Extent extent;

  // One of the roads.
  struct Road {
    double half_width;
    double crown;     // height of its middle above its edge
    double grade;     // m/m
    double sag;       // change of the grade, 1/m
    Interval island;  // along the road, from the middle of the junction; empty for none
  };
  Road own, side;  // along x, along y
  double corner;   // radius of the kerb between the roads
  double kerb_height;
  double sidewalk;  // width
  double island_height;
  Interval bed_x, bed_y;              // extent of the flower beds at the corners
  std::array<double, 4> bed_heights;  // 0 for none; see quadrant()
  std::array<bool, 4> lawn;           // lawn instead of slabs behind the sidewalk

  // 0 if x and y are positive, then counter-clockwise.
  static std::size_t quadrant(double x, double y) noexcept {
    return y > 0 ? (x > 0 ? 0U : 1U) : (x > 0 ? 3U : 2U);
  }
  // Start of the zebra crossings over a road, from the middle of the junction.
  [[nodiscard]] double crossing_begin(const Road& other) const noexcept {
    return other.half_width + corner + 0.5;
  }
  // Middles of all junctions.
  [[nodiscard]] std::vector<double> junctions() const;
  // x relative to the nearest junction.
  [[nodiscard]] double from_junction(double x) const noexcept;
  // Signed distance to the kerb, positive behind it.
  [[nodiscard]] double behind_kerb(double x, double y) const noexcept;

  [[nodiscard]] double height(double x, double y) const noexcept;
  [[nodiscard]] Surface surface(double x, double y) const noexcept;
};

constexpr double face = 0.02;     // of kerbs, which are tilted back
constexpr double fine = 0.12;     // distance of grid lines at round kerbs
constexpr double rim = 0.15;      // of islands and beds
constexpr double ramp = 0.6;      // next to a lowered kerb
constexpr double stripe = 0.5;    // of a zebra crossing
constexpr double low_kerb = 0.2;  // fraction of the kerb height that remains at a crossing

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.22F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface slabs{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface soil{.semantic = SemanticClass::terrain, .reflectivity = 0.25F};

// Distance to the ends of an interval, negative outside.
double within(Interval interval, double value) noexcept {
  return std::min(value - interval.low, interval.high - value);
}

// Signed distance to the edge of an island or bed, positive inside. `ahead` is along the road.
double within_island(const CrossroadsShape::Road& road, double ahead, double aside) noexcept {
  return std::min(within(road.island, std::abs(ahead)),
                  CrossroadsShape::island_half_width - std::abs(aside));
}
double within_bed(const CrossroadsShape& shape, double x, double y) noexcept {
  return std::min(within(shape.bed_x, std::abs(x)), within(shape.bed_y, std::abs(y)));
}

// 1 on a zebra crossing over a road, decreasing to 0 next to it.
double on_crossing(double begin, double ahead) noexcept {
  const double inside = within({begin, begin + CrossroadsShape::crossing_width}, std::abs(ahead));
  return std::clamp(1 + inside / ramp, 0.0, 1.0);
}

// Height of the crown: a parabola, 0 at the edge of the road and beyond.
double crown_of(const CrossroadsShape::Road& road, double aside) noexcept {
  const double share = aside / road.half_width;
  return road.crown * std::max(0.0, 1 - share * share);
}

double along_grade(const CrossroadsShape::Road& road, double ahead) noexcept {
  return road.grade * ahead + road.sag * ahead * ahead / 2;
}

// Grid lines across one of the axes; `road` is along the other axis.
std::vector<double> lines(const CrossroadsShape& shape, const CrossroadsShape::Road& road,
                          const CrossroadsShape::Road& along, Interval bed, double half) {
  const double edge = road.half_width;
  std::vector<double> outward;
  add_lines(outward, 0, edge, 0.5);
  for (double at = 0; at < edge; at += stripe) outward.push_back(at);
  outward.push_back(0.08);  // edge of the marking in the middle
  add_lines(outward, edge, edge + face, face);
  add_lines(outward, edge + face, edge + shape.corner, fine);
  add_lines(outward, edge + shape.corner, half, 1);
  outward.push_back(edge + shape.sidewalk);
  const double crossing = shape.crossing_begin(road);
  for (const double end : {crossing - ramp, crossing, crossing + CrossroadsShape::crossing_width,
                           crossing + CrossroadsShape::crossing_width + ramp}) {
    outward.push_back(end);
  }
  const auto add_island = [&](Interval reach) {
    for (const double inside : {0.0, face, rim}) {
      outward.push_back(reach.low + inside);
      outward.push_back(reach.high - inside);
    }
  };
  add_island(bed);
  if (along.island.high > 0) add_island(along.island);
  if (road.island.high > 0)
    add_island({-CrossroadsShape::island_half_width, CrossroadsShape::island_half_width});
  std::vector<double> both;
  for (const double at : outward) {
    both.push_back(at);
    both.push_back(-at);
  }
  finish_lines(both);
  return both;
}

CrossroadsShape::Road draw_road(Interval half_width, Random& random) {
  return {.half_width = random.uniform(half_width.low, half_width.high),
          .crown = random.uniform(0.06, 0.15),
          .grade = random.uniform(-0.035, 0.035),
          .sag = random.uniform(-4e-4, 4e-4),
          .island = {}};
}

std::vector<double> CrossroadsShape::junctions() const {
  const std::size_t whole = extent.stretches / period;
  const std::size_t count = extent.closed ? whole : (extent.stretches + period - 1) / period;
  std::vector<double> all;
  all.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(static_cast<double>(i * period) * stretch_length);
  }
  return all;
}

double CrossroadsShape::from_junction(double x) const noexcept {
  if (!extent.is_long()) return x;
  constexpr double apart = period * stretch_length;
  const double last = junctions().back();
  const double next = extent.closed ? x - extent.length() : x;  // to the first one, after a lap
  const double here = x - std::clamp(std::round(x / apart) * apart, 0.0, last);
  return std::abs(next) < std::abs(here) ? next : here;
}

double CrossroadsShape::behind_kerb(double x, double y) const noexcept {
  const double from_side = std::abs(x) - side.half_width;
  const double from_own = std::abs(y) - own.half_width;
  const double to_side = corner - from_side;
  const double to_own = corner - from_own;
  const bool at_corner = from_side > 0 && from_own > 0 && to_side > 0 && to_own > 0;
  return at_corner ? corner - std::hypot(to_side, to_own) : std::min(from_side, from_own);
}

double CrossroadsShape::height(double x, double y) const noexcept {
  const double one = crown_of(own, y);
  const double other = crown_of(side, x);
  // Combines the crowns: the higher one in the middle of the junction, each one on its own arms.
  double height = along_grade(own, x) + along_grade(side, y) + one + other -
                  one * other / std::max(own.crown, side.crown);
  const double behind = behind_kerb(x, y);
  const double low =
      std::max(on_crossing(crossing_begin(side), x) * (std::abs(y) > own.half_width),
               on_crossing(crossing_begin(own), y) * (std::abs(x) > side.half_width));
  const double deep = std::clamp(behind / sidewalk, 0.0, 1.0);
  height +=
      kerb_height * std::clamp(behind / face, 0.0, 1.0) * (1 - (1 - low_kerb) * low * (1 - deep));
  const auto raised = [](double by, double inside) {
    return by * std::clamp(inside / face, 0.0, 1.0);
  };
  height += raised(bed_heights[quadrant(x, y)], within_bed(*this, x, y));
  height += raised(island_height, std::max(within_island(own, x, y), within_island(side, y, x)));
  return height;
}

Surface CrossroadsShape::surface(double x, double y) const noexcept {
  const double behind = behind_kerb(x, y);
  const double island = std::max(within_island(own, x, y), within_island(side, y, x));
  if (island > 0) return island > rim ? grass : slabs;
  // A cell that is crossed by a round kerb is part of the kerb.
  const bool round = std::abs(x) > side.half_width && std::abs(y) > own.half_width;
  if (behind > (round ? -fine / 2 : 0)) {
    const std::size_t corner_index = quadrant(x, y);
    const double bed = within_bed(*this, x, y);
    if (bed > 0 && bed_heights[corner_index] > 0) return bed > rim ? soil : slabs;
    return behind > sidewalk && lawn[corner_index] ? grass : slabs;
  }
  const auto striped = [](double aside) {
    return static_cast<int>(std::abs(aside) / stripe) % 2 == 0 ? paint : asphalt;
  };
  if (on_crossing(crossing_begin(side), x) == 1) return striped(y);
  if (on_crossing(crossing_begin(own), y) == 1) return striped(x);
  const bool centre_of_own = std::abs(y) < 0.08 && std::abs(x) > crossing_begin(side);
  const bool centre_of_side = std::abs(x) < 0.08 && std::abs(y) > crossing_begin(own);
  return centre_of_own || centre_of_side ? paint : asphalt;
}

CrossroadsShape draw_crossroads(const Extent& extent, Random& random) {
  CrossroadsShape shape{.extent = extent,
                        .own = draw_road({4, 7}, random),
                        .side = draw_road({3.4, 6.5}, random),
                        .corner = random.uniform(3, 6.5),
                        .kerb_height = random.uniform(0.09, 0.16),
                        .sidewalk = random.uniform(3, 4.5),
                        .island_height = random.uniform(0.1, 0.2),
                        .bed_x = {},
                        .bed_y = {},
                        .bed_heights = {},
                        .lawn = {}};
  const double wide_enough = 5.2;  // for a lane and half of an island
  const auto add_island = [&](CrossroadsShape::Road& road, const CrossroadsShape::Road& other) {
    if (road.half_width < wide_enough) return;
    const double begin = shape.crossing_begin(other) + CrossroadsShape::crossing_width + 0.8;
    road.island = {begin, begin + random.uniform(6, 16)};
  };
  add_island(shape.own, shape.side);
  add_island(shape.side, shape.own);
  const double bed_x = shape.side.half_width + shape.corner + CrossroadsShape::crossing_width + 2;
  const double bed_y = shape.own.half_width + random.uniform(1, 1.4);
  shape.bed_x = {bed_x, bed_x + random.uniform(4, 9)};
  shape.bed_y = {bed_y, bed_y + random.uniform(1, 1.6)};
  for (double& height : shape.bed_heights) {
    height = random.chance(0.75) ? random.uniform(0.1, 0.3) : 0;
  }
  for (bool& lawn : shape.lawn) lawn = random.chance(0.4);
  if (extent.is_long()) {  // its Alignment has the grades
    shape.own.grade = 0;
    shape.own.sag = 0;
  }
  return shape;
}

// Grid lines across the road along x, with all its junctions.
std::vector<double> lines_along(const CrossroadsShape& shape) {
  std::vector<double> one =
      lines(shape, shape.side, shape.own, shape.bed_x, CrossroadsShape::half_length);
  const Extent& extent = shape.extent;
  if (!extent.is_long()) return one;
  constexpr double beyond = CrossroadsShape::half_length - half_drive;
  const Interval reach = extent.reach(beyond);
  std::vector<double> all;
  add_lines(all, reach.low, reach.high, 1);
  for (const double junction : shape.junctions()) {
    for (const double line : one) {
      const double x = junction + line;
      if (x > reach.low && x < reach.high) all.push_back(x);
      if (extent.closed && x < reach.low) all.push_back(x + extent.length());
    }
  }
  finish_lines(all);
  return all;
}

Ground make_ground(const CrossroadsShape& shape) {
  return cut_ground(
      {.x = lines_along(shape),
       .t = lines(shape, shape.own, shape.side, shape.bed_y, CrossroadsShape::half_width),
       .offset = [](double) { return 0.0; },
       .height = [&](double x, double y) { return shape.height(shape.from_junction(x), y); },
       .surface = [&](double x, double y) { return shape.surface(shape.from_junction(x), y); },
       .closed = shape.extent.closed});
}

constexpr double half_turn = std::numbers::pi;

// Distance between the middle of a road and the middles of its lanes.
double lane_of(const CrossroadsShape::Road& road) noexcept {
  const double begin = road.island.high > 0 ? CrossroadsShape::island_half_width : 0;
  return (begin + road.half_width) / 2;
}

// Adds objects to a junction, at positions relative to its middle. The quadrant is given by signs:
// +1 or -1 along x and along y.
class Furnisher {
 public:
  Furnisher(const CrossroadsShape& shape, const Ground& ground, double junction, Random& random)
      : shape_(shape), ground_(ground), junction_(junction), random_(random) {
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
    const double road_x = junction_ + x;
    return upright_frame({road_x, y, ground_.height(road_x, y)}, yaw);
  }

  TerraceHouse draw_house() {
    return {.width = random_.uniform(8, 14),
            .depth = 11,
            .storeys = 2 + static_cast<int>(random_.uniform(0, 4)),
            .shop = random_.chance(0.6)};
  }

  // Houses along both roads, starting at the corner. The y axis of a house points into it.
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
        plant(mesh_, ground_, junction_ + sx * random_.uniform(begin_x + margin, 80),
              sy * random_.uniform(begin_y + margin, 50), random_);
      }
    };
    scatter(9, 2, add_tree);
    scatter(18, 1, add_bush);
    scatter(300, 0, add_tuft);
    scatter(10, 1, add_ground_cover);
    if (random_.chance(0.5)) {
      add_hedge(mesh_, ground_,
                {.x0 = junction_ + sx * (begin_x + 4),
                 .y0 = sy * begin_y,
                 .x1 = junction_ + sx * 60,
                 .y1 = sy * begin_y},
                random_);
    }
  }

  void plant_bed(double sx, double sy) {
    if (shape_.bed_heights[CrossroadsShape::quadrant(sx, sy)] == 0) return;
    const Interval x = shape_.bed_x;
    const Interval y = shape_.bed_y;
    constexpr double margin = 0.3;
    for (int tuft = 0; tuft < 40; ++tuft) {
      add_tuft(mesh_, ground_, junction_ + sx * random_.uniform(x.low + margin, x.high - margin),
               sy * random_.uniform(y.low + margin, y.high - margin), random_);
    }
  }

  void plant_island(double sx) {
    const Interval reach = shape_.own.island;
    if (reach.high == 0) return;
    for (int tuft = 0; tuft < 25; ++tuft) {
      add_tuft(mesh_, ground_, junction_ + sx * random_.uniform(reach.low + 0.3, reach.high - 0.3),
               random_.uniform(-0.6, 0.6), random_);
    }
    add_traffic_sign(mesh_, upright(sx * (reach.low + 0.4), 0, sx > 0 ? 0 : half_turn));
  }

  void line_kerbs(double sx, double sy) {
    // Bollards along the round kerb of the corner.
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

  // Traffic lights are before the crossings, on the right in the direction of traffic.
  void put_up_lights(double sx, double sy) {
    constexpr double before = 0.7;          // metres before the crossing
    const bool right_of_own = sx * sy > 0;  // traffic from x < 0 is at y < 0
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
  double junction_;  // x of its middle
  Random& random_;
  Mesh mesh_;
};

RoadUser draw_vehicle(Random& random) {
  const double drawn = random.uniform();
  if (drawn < 0.7) return RoadUser::car;
  if (drawn < 0.8) return RoadUser::truck;
  return drawn < 0.9 ? RoadUser::bus : RoadUser::cyclist;
}

// Vehicles on the side road wait at the crossing, or cross the junction while it is free.
void send_crossing_traffic(Traffic& traffic, const CrossroadsShape& shape, double junction,
                           Random& random) {
  constexpr double lead = 12;  // seconds
  const double start = arrival_at(shape.extent, junction);
  for (const double from : {-1.0, 1.0}) {
    const double x = junction - from * lane_of(shape.side);
    const double yaw = -from * half_turn / 2;
    const double stop_line = shape.crossing_begin(shape.own) + CrossroadsShape::crossing_width + 1;
    const bool waits = random.chance(0.5);
    double y = waits ? stop_line : -60;
    while (y < 65) {
      const RoadUser kind = draw_vehicle(random);
      const double half = kind == RoadUser::truck || kind == RoadUser::bus ? 7.8 : 2.7;
      y += half;
      traffic.join(
          {.kind = kind,
           .at = straight({.x = x, .y = from * y, .yaw = yaw}, waits ? 0 : 9, 120, start, lead),
           .look = random.bits()});
      y += half + (waits ? random.uniform(1, 2) : random.uniform(6, 20));
    }
  }
}

void send_pedestrians(Traffic& traffic, const CrossroadsShape& shape, double junction,
                      Random& random) {
  const double start = arrival_at(shape.extent, junction);
  const auto walk = [&](double x, double y, double yaw, double way) {
    traffic.join({.kind = RoadUser::person,
                  .at = straight({.x = junction + x, .y = y, .yaw = yaw}, random.uniform(0.7, 1.6),
                                 way, start),
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
  // Pedestrians walk along the sidewalks, up to the crossing.
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
  Traffic traffic(route, shape.extent.view());
  traffic.fill(
      {.path = middle, .t = -lane, .speed = own_speed, .x = shape.extent.run(49), .gap = {12, 40}},
      draw_vehicle, random);
  traffic.fill({.path = middle,
                .t = lane,
                .speed = random.uniform(-11, -7),
                .x = shape.extent.run(54),
                .gap = {8, 30}},
               draw_vehicle, random);
  for (const double junction : shape.extent.each_lap(shape.junctions())) {
    send_crossing_traffic(traffic, shape, junction, random);
    send_pedestrians(traffic, shape, junction, random);
  }
  return traffic;
}

}  // namespace

Landscape crossroads(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  const CrossroadsShape shape = draw_crossroads(extent, random);
  const double lane = -lane_of(shape.own);
  std::vector<Stop> route =
      wander_along([&](double x) { return Stop{.x = x, .y = lane, .yaw = 0}; }, random, extent);
  Traffic traffic = send_traffic(shape, route, random);
  return {.ground = make_ground(shape),
          .route = std::move(route),
          .furnish =
              [shape, random](const Ground& on, const Stretch& stretch) {
                if (stretch.index % CrossroadsShape::period != 0) return Mesh();
                const double junction = static_cast<double>(stretch.index) * stretch_length;
                if (junction > shape.junctions().back()) return Mesh();
                Random own = stretch.stream(random);
                return Furnisher(shape, on, junction, own).take();
              },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
