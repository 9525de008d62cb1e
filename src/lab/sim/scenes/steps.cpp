// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/road_edge.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 112.5;  // of the ground, metres
constexpr double half_width = 45;
constexpr double block_length = 15;  // along the road, with one kind of edge on each side
constexpr double blend = 1.5;        // at each end of a block, for the transition to the next
constexpr auto block_count = static_cast<std::size_t>(2 * half_length / block_length);
constexpr double lane = -1.6;  // path of the sensor, metres left of the centre line

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.24F};
constexpr Surface slabs{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface concrete{.semantic = SemanticClass::other_ground, .reflectivity = 0.38F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};

// A kind of edge, either directly at the road or behind a strip of grass.
struct PlacedKind {
  EdgeKind kind;
  bool at_road;
};

PlacedKind kerb(std::string_view name, double height) {
  constexpr double face = 0.02;  // tilted back, so that the ground stays a function of x and y
  return {.kind = {.corners = {{0, 0}, {face, height}}, .slopes = {{name, 0, 1}}, .surface = slabs},
          .at_road = true};
}

PlacedKind beside_road(EdgeKind kind) { return {.kind = std::move(kind), .at_road = false}; }

PlacedKind wall_down(std::string_view name, double depth) {
  constexpr double face = 0.05;
  return beside_road(
      {.corners = {{0, 0}, {face, -depth}}, .slopes = {{name, 0, 1}}, .surface = concrete});
}

// A ditch with two slopes of width `slope` and a bottom of width `bottom`.
PlacedKind ditch(std::string_view down, std::string_view up_again, double depth, double slope,
                 double bottom) {
  return beside_road(
      {.corners = {{0, 0}, {slope, -depth}, {slope + bottom, -depth}, {2 * slope + bottom, 0}},
       .slopes = {{down, 0, 1}, {up_again, 2, 3}},
       .surface = grass});
}

PlacedKind slope_down(std::string_view name, double depth, double width) {
  return beside_road(
      {.corners = {{0, 0}, {width, -depth}}, .slopes = {{name, 0, 1}}, .surface = grass});
}

PlacedKind flight_of_stairs() {
  constexpr int rises = 5;
  constexpr double rise = 0.16;
  constexpr double tread = 0.3;
  constexpr double face = 0.02;
  std::vector<EdgeCorner> corners;
  for (int i = 0; i < rises; ++i) {
    corners.push_back({i * tread, i * rise});
    corners.push_back({i * tread + face, (i + 1) * rise});
  }
  const std::size_t last = corners.size() - 1;
  return {.kind = {.corners = std::move(corners),
                   .slopes = {{"stairs, 5 x 16 cm up", 0, last}},
                   .surface = concrete},
          .at_road = false};
}

// Edges of all kinds.
const std::vector<PlacedKind>& mixed_edges() {
  static const std::vector<PlacedKind> kinds{
      kerb("kerb, 5 cm up", 0.05),
      kerb("kerb, 10 cm up", 0.10),
      kerb("kerb, 15 cm up", 0.15),
      ditch("ditch, 60 cm down", "ditch, 60 cm up again", 0.6, 0.6, 1.2),
      wall_down("retaining wall, 1 m down", 1),
      flight_of_stairs(),
      {.kind = {.corners = {{0, 0}, {3, 1.5}, {5, 1.5}, {8, 0}},
                .slopes = {{"embankment, 1.5 m up", 0, 1}},
                .surface = grass},
       .at_road = false}};
  return kinds;
}

// Edges with deep drops.
const std::vector<PlacedKind>& deep_edges() {
  static const std::vector<PlacedKind> kinds{
      wall_down("quay, 1.5 m down", 1.5),
      wall_down("quay, 2 m down", 2),
      wall_down("quay, 3 m down", 3),
      ditch("ditch, 1 m down", "ditch, 1 m up again", 1, 0.7, 1.2),
      ditch("ditch, 1.5 m down", "ditch, 1.5 m up again", 1.5, 1, 1.5),
      slope_down("embankment, 1.5 m down", 1.5, 2.5),
      slope_down("embankment, 3 m down", 3, 4.5)};
  return kinds;
}

// The road is straight along x; t = y is measured to the left of its centre line.
struct Road {
  double half_road, grade, cross_fall;
  std::array<EdgeRow, 2> edges;  // right and left

  [[nodiscard]] const EdgeRow& side(double t) const noexcept { return edges[t > 0]; }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double out = std::abs(t);
    const double on_road = std::min(out / half_road, 1.0);
    constexpr double crown = 0.05;
    const double across = cross_fall * std::clamp(t, -half_road, half_road);
    return grade * x - crown * on_road * on_road + across + side(t).height(x, out);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = std::abs(t);
    if (out < half_road) return asphalt;
    const Edge& edge = side(t).edge_at(x);
    return out < edge.begin ? grass : edge.kind->surface;
  }
};

// Repeats all kinds in random order.
std::vector<Edge> draw_edges(const std::vector<PlacedKind>& kinds, double half_road,
                             Random& random) {
  std::vector<std::size_t> order;
  std::vector<Edge> edges;
  while (edges.size() < block_count) {
    if (order.empty()) {
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) order.push_back(kind);
    }
    const auto drawn =
        static_cast<std::size_t>(random.uniform() * static_cast<double>(order.size()));
    const PlacedKind& placed = kinds[order[drawn]];
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(drawn));
    const double strip = random.uniform(0.6, 2.5);
    edges.push_back({&placed.kind, half_road + (placed.at_road ? 0 : strip)});
  }
  return edges;
}

Road draw_road(const std::vector<PlacedKind>& kinds, Random& random) {
  Road road{.half_road = random.uniform(3, 3.8),
            .grade = random.uniform(-0.01, 0.01),
            .cross_fall = random.uniform(-0.01, 0.01),
            .edges = {}};
  for (EdgeRow& side : road.edges) {
    side = {.x_begin = -half_length,
            .block_length = block_length,
            .blend = blend,
            .blocks = draw_edges(kinds, road.half_road, random)};
  }
  return road;
}

std::vector<double> lines_across(const Road& road) {
  constexpr double step = 0.5;
  std::vector<double> lines{-road.half_road, road.half_road};
  for (double t = -half_width; t <= half_width; t += step) lines.push_back(t);
  for (const double sign : {-1.0, 1.0}) {
    for (const double out : road.side(sign).corner_lines()) lines.push_back(sign * out);
  }
  finish_lines(lines);
  return lines;
}

std::vector<double> lines_along(const Road& road) {
  constexpr double step = 2.5;
  std::vector<double> lines;
  for (double x = -half_length; x <= half_length; x += step) lines.push_back(x);
  for (const double x : road.side(1).blend_lines()) lines.push_back(x);
  finish_lines(lines);
  return lines;
}

Ground make_road(const Road& road) {
  return cut_ground({.x = lines_along(road),
                     .t = lines_across(road),
                     .offset = [](double) { return 0.0; },
                     .height = [&](double x, double t) { return road.height(x, t); },
                     .surface = [&](double x, double t) { return road.surface(x, t); }});
}

// Few objects, because an object in front of a step hides it.
Mesh furnish_road(double half_road, const Ground& ground, Random random) {
  constexpr double planted = 95;  // half of the length, metres
  Mesh mesh;
  const auto scatter = [&](int count, double out_begin, double out_end, auto add) {
    for (int i = 0; i < count; ++i) {
      const double x = random.uniform(-planted, planted);
      const double out = random.uniform(out_begin, out_end);
      const double y = random.chance(0.5) ? out : -out;
      add(x, y);
    }
  };
  const auto stand = [&](double x, double y) {
    return upright_frame({x, y, ground.height(x, y)}, (y > 0 ? -1 : 1) * std::numbers::pi / 2);
  };
  scatter(30, 14, 40, [&](double x, double y) { add_tree(mesh, ground, x, y, random); });
  scatter(40, 9, 40, [&](double x, double y) { add_bush(mesh, ground, x, y, random); });
  scatter(600, 9, 30, [&](double x, double y) { add_tuft(mesh, ground, x, y, random); });
  scatter(6, 7, 9, [&](double x, double y) { add_lamp_post(mesh, stand(x, y)); });
  scatter(4, 7, 9, [&](double x, double y) { add_traffic_sign(mesh, stand(x, y)); });
  for (const double x : {-60.0, 55.0}) {
    const double at = x + random.uniform(-15, 15);
    constexpr double wheelbase = 2.6;
    constexpr double track = 1.5;
    add_car(mesh, frame_on_wheels(ground, at, half_road / 2, std::numbers::pi, wheelbase, track),
            random);
  }
  return mesh;
}

Landscape road_along(const std::vector<PlacedKind>& kinds, std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Road road = draw_road(kinds, random);
  Ground ground = make_road(road);
  std::vector<Stop> route =
      wander_along([](double x) { return Stop{.x = x, .y = lane, .yaw = 0}; }, random);
  std::vector<GroundStep> known = road.side(-1).steps(-1);
  std::ranges::copy(road.side(1).steps(1), std::back_inserter(known));
  const double half_road = road.half_road;
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [half_road, random](
                         const Ground& on,
                         const Stretch& /*whole*/) { return furnish_road(half_road, on, random); },
          .steps = std::move(known)};
}

}  // namespace

Landscape steps(std::uint64_t seed) { return road_along(mixed_edges(), seed); }

Landscape drops(std::uint64_t seed) { return road_along(deep_edges(), seed); }

}  // namespace flagstone::sim
