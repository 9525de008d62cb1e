// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/scenes/crossroads_shape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lab/sim/ground_plan.hpp"

namespace flagstone::sim {
namespace {

constexpr double face = 0.02;     // of kerbs: they lean back
constexpr double fine = 0.12;     // lines where kerbs are round
constexpr double rim = 0.15;      // of islands and beds
constexpr double ramp = 0.6;      // beside a lowered kerb
constexpr double stripe = 0.5;    // of a zebra crossing
constexpr double low_kerb = 0.2;  // share of the kerb that stays at a crossing

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.22F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface slabs{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};
constexpr Surface soil{.semantic = SemanticClass::terrain, .reflectivity = 0.25F};

// How far within an interval, 0 at its ends and below 0 outside.
double within(Interval interval, double value) noexcept {
  return std::min(value - interval.low, interval.high - value);
}

// To the edge of an island or bed, above 0 inside; the road runs along `ahead`.
double within_island(const CrossroadsShape::Road& road, double ahead, double aside) noexcept {
  return std::min(within(road.island, std::abs(ahead)),
                  CrossroadsShape::island_half_width - std::abs(aside));
}
double within_bed(const CrossroadsShape& shape, double x, double y) noexcept {
  return std::min(within(shape.bed_x, std::abs(x)), within(shape.bed_y, std::abs(y)));
}

// 1 on the way of a zebra crossing over a road, 0 well beside.
double on_crossing(double begin, double ahead) noexcept {
  const double inside = within({begin, begin + CrossroadsShape::crossing_width}, std::abs(ahead));
  return std::clamp(1 + inside / ramp, 0.0, 1.0);
}

// A parabola, 0 from the road's edge on.
double crown_of(const CrossroadsShape::Road& road, double aside) noexcept {
  const double share = aside / road.half_width;
  return road.crown * std::max(0.0, 1 - share * share);
}

double along_grade(const CrossroadsShape::Road& road, double ahead) noexcept {
  return road.grade * ahead + road.sag * ahead * ahead / 2;
}

// Lines across one of the axes, of which `road` runs along the other one.
std::vector<double> lines(const CrossroadsShape& shape, const CrossroadsShape::Road& road,
                          const CrossroadsShape::Road& along, Interval bed, double half) {
  const double edge = road.half_width;
  std::vector<double> outward;
  add_lines(outward, 0, edge, 0.5);
  for (double at = 0; at < edge; at += stripe) outward.push_back(at);
  outward.push_back(0.08);  // of the marking in the middle
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

}  // namespace

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
  // The higher one in the middle of the junction, each of them on its own arms.
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
  // A cell that a round kerb cuts is part of the kerb.
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

CrossroadsShape draw_crossroads(Random& random) {
  CrossroadsShape shape{.own = draw_road({4, 7}, random),
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
  return shape;
}

Ground make_ground(const CrossroadsShape& shape) {
  return cut_ground(
      {.x = lines(shape, shape.side, shape.own, shape.bed_x, CrossroadsShape::half_length),
       .t = lines(shape, shape.own, shape.side, shape.bed_y, CrossroadsShape::half_width),
       .offset = [](double) { return 0.0; },
       .height = [&](double x, double y) { return shape.height(x, y); },
       .surface = [&](double x, double y) { return shape.surface(x, y); }});
}

}  // namespace flagstone::sim
