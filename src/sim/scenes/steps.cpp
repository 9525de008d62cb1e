// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/car.hpp"
#include "sim/plants.hpp"
#include "sim/scenes/scenes.hpp"
#include "sim/street_furniture.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 112.5;  // of the ground, metres
constexpr double half_width = 45;
constexpr double block_length = 15;  // along the road: one kind of edge on either side
constexpr double blend = 1.5;        // at either end of a block it turns into the next
constexpr auto block_count = static_cast<std::size_t>(2 * half_length / block_length);
constexpr double lane = -1.6;  // where the sensor drives, metres left of the centre line

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.24F};
constexpr Surface slabs{.semantic = SemanticClass::sidewalk, .reflectivity = 0.36F};
constexpr Surface concrete{.semantic = SemanticClass::other_ground, .reflectivity = 0.38F};
constexpr Surface grass{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};

// A corner of a cross-section: metres outward from where the edge begins, and up.
struct Corner {
  double out, height;
};

// A slope of an edge whose height is measured: between two of its corners.
struct MeasuredSlope {
  std::string_view name;
  std::size_t from, to;
};

// What lies beside the road.
struct EdgeKind {
  std::vector<Corner> corners;  // level before the first and behind the last
  std::vector<MeasuredSlope> slopes;
  Surface surface;
  bool at_road;  // or a strip of grass lies between
};

EdgeKind kerb(std::string_view name, double height) {
  constexpr double face = 0.02;  // leans back, so that the ground stays a function of x and y
  return {.corners = {{0, 0}, {face, height}},
          .slopes = {{name, 0, 1}},
          .surface = slabs,
          .at_road = true};
}

EdgeKind wall_down(std::string_view name, double depth) {
  constexpr double face = 0.05;
  return {.corners = {{0, 0}, {face, -depth}},
          .slopes = {{name, 0, 1}},
          .surface = concrete,
          .at_road = false};
}

// Both slopes as wide as `slope`, the bottom between them as `bottom`.
EdgeKind ditch(std::string_view down, std::string_view up_again, double depth, double slope,
               double bottom) {
  return {.corners = {{0, 0}, {slope, -depth}, {slope + bottom, -depth}, {2 * slope + bottom, 0}},
          .slopes = {{down, 0, 1}, {up_again, 2, 3}},
          .surface = grass,
          .at_road = false};
}

EdgeKind slope_down(std::string_view name, double depth, double width) {
  return {.corners = {{0, 0}, {width, -depth}},
          .slopes = {{name, 0, 1}},
          .surface = grass,
          .at_road = false};
}

EdgeKind flight_of_stairs() {
  constexpr int rises = 5;
  constexpr double rise = 0.16;
  constexpr double tread = 0.3;
  constexpr double face = 0.02;
  std::vector<Corner> corners;
  for (int i = 0; i < rises; ++i) {
    corners.push_back({i * tread, i * rise});
    corners.push_back({i * tread + face, (i + 1) * rise});
  }
  const std::size_t last = corners.size() - 1;
  return {.corners = std::move(corners),
          .slopes = {{"stairs, 5 x 16 cm up", 0, last}},
          .surface = concrete,
          .at_road = false};
}

// Edges of all sorts.
const std::vector<EdgeKind>& mixed_edges() {
  static const std::vector<EdgeKind> kinds{
      kerb("kerb, 5 cm up", 0.05),
      kerb("kerb, 10 cm up", 0.10),
      kerb("kerb, 15 cm up", 0.15),
      ditch("ditch, 60 cm down", "ditch, 60 cm up again", 0.6, 0.6, 1.2),
      wall_down("retaining wall, 1 m down", 1),
      flight_of_stairs(),
      {.corners = {{0, 0}, {3, 1.5}, {5, 1.5}, {8, 0}},
       .slopes = {{"embankment, 1.5 m up", 0, 1}},
       .surface = grass,
       .at_road = false}};
  return kinds;
}

// Edges that lead deep down.
const std::vector<EdgeKind>& deep_edges() {
  static const std::vector<EdgeKind> kinds{
      wall_down("quay, 1.5 m down", 1.5),
      wall_down("quay, 2 m down", 2),
      wall_down("quay, 3 m down", 3),
      ditch("ditch, 1 m down", "ditch, 1 m up again", 1, 0.7, 1.2),
      ditch("ditch, 1.5 m down", "ditch, 1.5 m up again", 1.5, 1, 1.5),
      slope_down("embankment, 1.5 m down", 1.5, 2.5),
      slope_down("embankment, 3 m down", 3, 4.5)};
  return kinds;
}

// One block of one side of the road.
struct Edge {
  const EdgeKind* kind;
  double begin;  // metres from the centre line
  [[nodiscard]] double height(double out) const noexcept {
    const std::span<const Corner> corners = kind->corners;
    double at = 0;
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const double length = corners[i].out - corners[i - 1].out;
      const double share = std::clamp((out - begin - corners[i - 1].out) / length, 0.0, 1.0);
      at += share * (corners[i].height - corners[i - 1].height);
    }
    return at;
  }
};

// The road runs straight along x, t = y is measured to the left of its centre line.
struct Road {
  double half_road, grade, cross_fall;
  std::array<std::vector<Edge>, 2> edges;  // right and left, block by block along x

  [[nodiscard]] const std::vector<Edge>& side(double t) const noexcept { return edges[t > 0]; }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double out = std::abs(t);
    const double on_road = std::min(out / half_road, 1.0);
    constexpr double crown = 0.05;
    const double across = cross_fall * std::clamp(t, -half_road, half_road);
    return grade * x - crown * on_road * on_road + across + edge_height(x, t);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = std::abs(t);
    if (out < half_road) return asphalt;
    const Edge& edge = side(t)[block_at(x)];
    return out < edge.begin ? grass : edge.kind->surface;
  }
  [[nodiscard]] static double block_begin(std::size_t block) noexcept {
    return -half_length + static_cast<double>(block) * block_length;
  }

 private:
  [[nodiscard]] static std::size_t block_at(double x) noexcept {
    const double block =
        std::clamp((x + half_length) / block_length, 0.0, static_cast<double>(block_count) - 0.5);
    return static_cast<std::size_t>(block);
  }
  [[nodiscard]] double edge_height(double x, double t) const noexcept {
    const std::vector<Edge>& blocks = side(t);
    const std::size_t block = block_at(x);
    const double own = blocks[block].height(std::abs(t));
    const double from_begin = x - block_begin(block);
    const double from_end = block_length - from_begin;
    const bool at_begin = from_begin < from_end;
    if ((at_begin && block == 0) || (!at_begin && block + 1 == block_count)) return own;
    const double next = blocks[at_begin ? block - 1 : block + 1].height(std::abs(t));
    // Half of both on the border between the two.
    const double share = std::min(0.5 + std::min(from_begin, from_end) / (2 * blend), 1.0);
    return share * own + (1 - share) * next;
  }
};

// All kinds in an order that the seed draws, again and again.
std::vector<Edge> draw_edges(const std::vector<EdgeKind>& kinds, double half_road, Random& random) {
  std::vector<std::size_t> order;
  std::vector<Edge> edges;
  while (edges.size() < block_count) {
    if (order.empty()) {
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) order.push_back(kind);
    }
    const auto drawn =
        static_cast<std::size_t>(random.uniform() * static_cast<double>(order.size()));
    const EdgeKind& kind = kinds[order[drawn]];
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(drawn));
    const double strip = random.uniform(0.6, 2.5);
    edges.push_back({&kind, half_road + (kind.at_road ? 0 : strip)});
  }
  return edges;
}

Road draw_road(const std::vector<EdgeKind>& kinds, Random& random) {
  Road road{.half_road = random.uniform(3, 3.8),
            .grade = random.uniform(-0.01, 0.01),
            .cross_fall = random.uniform(-0.01, 0.01),
            .edges = {}};
  for (std::vector<Edge>& side : road.edges) side = draw_edges(kinds, road.half_road, random);
  return road;
}

std::vector<double> sorted_apart(std::vector<double> lines) {
  constexpr double same = 1e-6;  // what only rounding tells apart
  std::ranges::sort(lines);
  const auto repeated = std::ranges::unique(lines, [](double a, double b) { return b - a < same; });
  lines.erase(repeated.begin(), repeated.end());
  return lines;
}

std::vector<double> lines_across(const Road& road) {
  constexpr double step = 0.5;
  std::vector<double> lines{-road.half_road, road.half_road};
  for (double t = -half_width; t <= half_width; t += step) lines.push_back(t);
  for (const double sign : {-1.0, 1.0}) {
    for (const Edge& edge : road.side(sign)) {
      for (const Corner& corner : edge.kind->corners) {
        lines.push_back(sign * (edge.begin + corner.out));
      }
    }
  }
  return sorted_apart(std::move(lines));
}

std::vector<double> lines_along() {
  constexpr double step = 2.5;
  std::vector<double> lines;
  for (double x = -half_length; x <= half_length; x += step) lines.push_back(x);
  for (std::size_t block = 1; block < block_count; ++block) {
    lines.push_back(Road::block_begin(block) - blend);
    lines.push_back(Road::block_begin(block) + blend);
  }
  return sorted_apart(std::move(lines));
}

Ground make_road(const Road& road) {
  GroundGrid grid{.x = lines_along(), .offset = {}, .t = lines_across(road)};
  grid.offset.assign(grid.x.size(), 0);
  std::vector<double> heights;
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < grid.x.size(); ++i) {
    for (const double t : grid.t) heights.push_back(road.height(grid.x[i], t));
    if (i + 1 == grid.x.size()) break;
    const double middle_x = (grid.x[i] + grid.x[i + 1]) / 2;
    for (std::size_t j = 0; j + 1 < grid.t.size(); ++j) {
      surfaces.push_back(road.surface(middle_x, (grid.t[j] + grid.t[j + 1]) / 2));
    }
  }
  return {std::move(grid), std::move(heights), std::move(surfaces)};
}

// Those of the parts of the blocks that are the same from end to end.
std::vector<GroundStep> steps_of(const Road& road) {
  std::vector<GroundStep> steps;
  for (const double sign : {-1.0, 1.0}) {
    const std::vector<Edge>& side = road.side(sign);
    for (std::size_t block = 0; block < block_count; ++block) {
      const Edge& edge = side[block];
      for (const MeasuredSlope& slope : edge.kind->slopes) {
        const Corner from = edge.kind->corners[slope.from];
        const Corner to = edge.kind->corners[slope.to];
        steps.push_back({.kind = slope.name,
                         .x_begin = Road::block_begin(block) + blend,
                         .x_end = Road::block_begin(block) + block_length - blend,
                         .y_begin = sign * (edge.begin + from.out),
                         .y_end = sign * (edge.begin + to.out),
                         .rise = to.height - from.height});
      }
    }
  }
  return steps;
}

// Little: what stands before a step hides it.
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

Landscape road_along(const std::vector<EdgeKind>& kinds, std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  Road road = draw_road(kinds, random);
  Ground ground = make_road(road);
  std::vector<Stop> route =
      wander_along([](double x) { return Stop{.x = x, .y = lane, .yaw = 0}; }, random);
  std::vector<GroundStep> known = steps_of(road);
  const double half_road = road.half_road;
  return {.ground = std::move(ground),
          .route = std::move(route),
          .furnish = [half_road,
                      random](const Ground& on) { return furnish_road(half_road, on, random); },
          .steps = std::move(known)};
}

}  // namespace

Landscape steps(std::uint64_t seed) { return road_along(mixed_edges(), seed); }

Landscape drops(std::uint64_t seed) { return road_along(deep_edges(), seed); }

}  // namespace flagstone::sim
