// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/open_land.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/road_edge.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_length = 112;  // of the ground, metres
constexpr double half_width = 75;
constexpr double block_length = 20;
constexpr double blend = 2;
constexpr std::size_t block_count = 12;
constexpr double level_land = 20;  // metres from the centre line; beyond it the land has waves

constexpr Surface asphalt{.semantic = SemanticClass::road, .reflectivity = 0.2F};
constexpr Surface marking{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface gravel{.semantic = SemanticClass::other_ground, .reflectivity = 0.32F};
constexpr Surface concrete{.semantic = SemanticClass::other_structure, .reflectivity = 0.4F};

// Objects along a block on the side of the dam.
enum class Furnished : std::uint8_t { open, railed, culvert };

struct Block {
  std::size_t kind;  // index into the kinds of the side
  Furnished furnished;
};

// The road is straight along x; t = y is measured to the left of its centre line.
struct Road {
  double half_road = 4.4;  // of the asphalt, metres
  double shoulder = 1.5;
  double grade = 0, cross_fall = 0;
  double dam_side = -1;  // +1: the slope of the dam is to the left, the cutting to the right
  DamMeasures measures;
  std::array<std::vector<EdgeKind>, 2> kinds;  // of the dam and of the cutting
  std::array<EdgeRow, 2> edges;
  std::vector<Furnished> furnished;  // on the side of the dam, block by block
  std::vector<Wave> land;

  static constexpr double line = 0.15;  // width of a marking, metres

  [[nodiscard]] double lane() const noexcept { return 0.53 * half_road; }
  [[nodiscard]] double edge() const noexcept { return half_road + shoulder; }
  [[nodiscard]] const EdgeRow& side(double t) const noexcept { return edges[t * dam_side < 0]; }
  [[nodiscard]] double height(double x, double t) const noexcept {
    const double out = std::abs(t);
    const double off_road = std::clamp(out - half_road, 0.0, shoulder);
    const double across = cross_fall * std::clamp(t, -half_road, half_road);
    return grade * x + across - 0.05 * off_road + side(t).height(x, out) +
           smooth_step(level_land, level_land + 10, out) * sum_at(land, x, t);
  }
  [[nodiscard]] Surface surface(double x, double t) const noexcept {
    const double out = std::abs(t);
    if (out > edge()) return side(t).edge_at(x).surface(out);
    if (out > half_road) return gravel;
    const bool dashed = out < line / 2 && std::fmod(x + 1000, 9) < 4;
    const bool at_side = out > half_road - 0.3 && out < half_road - 0.3 + line;
    return dashed || at_side ? marking : asphalt;
  }
};

// Consecutive blocks on the side of the dam. Every run passes every kind.
std::vector<Block> dam_blocks() {
  return {{0, Furnished::open}, {1, Furnished::culvert}, {2, Furnished::railed},
          {1, Furnished::open}, {2, Furnished::open},    {0, Furnished::railed}};
}

// On the heap, so that it does not move: the edges point to the kinds.
std::shared_ptr<const Road> draw_road(Random& random) {
  auto road = std::make_shared<Road>();
  road->half_road = random.uniform(4.2, 4.8);
  road->shoulder = random.uniform(1.2, 1.8);
  road->grade = random.uniform(-0.025, 0.025);
  road->cross_fall = random.uniform(-0.025, 0.025);
  road->dam_side = random.chance(0.5) ? 1 : -1;
  DamMeasures& measures = road->measures;
  measures.dam = random.uniform(2, 4);
  measures.run = random.uniform(1.5, 2);
  measures.drop = random.uniform(1, std::min(3.0, measures.dam));
  measures.cut = random.uniform(1.8, 3.2);
  measures.ditch = random.uniform(0.5, 1.5);
  measures.bottom = random.uniform(0.6, 1.4);
  measures.cut_ditch = random.uniform(0.3, 0.6);
  measures.wet = random.chance(0.5);
  road->kinds = {dam_kinds(measures), cutting_kinds(measures)};
  draw_waves(road->land, 5, {0.03, 0.15}, {9, 40}, random);

  const std::vector<Block> blocks = dam_blocks();
  const auto first = static_cast<std::size_t>(random.uniform(0, 6));
  for (EdgeRow& row : road->edges) {
    row = {.x_begin = -block_length * block_count / 2,
           .block_length = block_length,
           .blend = blend,
           .blocks = {}};
  }
  for (std::size_t i = 0; i < block_count; ++i) {
    const Block& block = blocks[(first + i) % blocks.size()];
    road->edges[0].blocks.push_back({&road->kinds[0][block.kind], road->edge()});
    road->furnished.push_back(block.furnished);
    const std::size_t cutting = random.chance(0.3) ? 1 : 0;
    road->edges[1].blocks.push_back({&road->kinds[1][cutting], road->edge()});
  }
  return road;
}

Ground make_road(const Road& road) {
  const double half_road = road.half_road;
  std::vector<double> across = mirrored_lines(std::array{
      LineBand{Road::line / 2, 1}, LineBand{half_road - 0.3, 1},
      LineBand{half_road - 0.3 + Road::line, 1}, LineBand{half_road, 1}, LineBand{road.edge(), 1},
      LineBand{level_land, 0.5}, LineBand{40, 1}, LineBand{half_width, 2.5}});
  for (const double sign : {-1.0, 1.0}) {
    for (const double out : road.side(sign).corner_lines()) across.push_back(sign * out);
  }
  finish_lines(across);
  std::vector<double> lengthwise = road.side(1).blend_lines();
  add_lines(lengthwise, -half_length, half_length, 1);
  finish_lines(lengthwise);
  return cut_ground({.x = std::move(lengthwise),
                     .t = std::move(across),
                     .offset = [](double) { return 0.0; },
                     .height = [&](double x, double t) { return road.height(x, t); },
                     .surface = [&](double x, double t) { return road.surface(x, t); }});
}

// A pipe through the dam, with a head wall at the base of the dam.
void add_culvert(Mesh& mesh, const Road& road, const Ground& ground, double x) {
  const double foot = road.edge() + road.measures.run * road.measures.dam;
  const double y = road.dam_side * (foot - 0.6);
  const double low = ground.height(x, road.dam_side * foot);
  const Frame frame = upright_frame({x, y, low}, road.dam_side * std::numbers::pi / 2);
  constexpr double radius = 0.45;
  add_box(mesh, frame, {.low = {0, -1.8, -0.5}, .high = {0.3, -radius, 1.3}}, concrete);
  add_box(mesh, frame, {.low = {0, radius, -0.5}, .high = {0.3, 1.8, 1.3}}, concrete);
  add_box(mesh, frame, {.low = {0, -1.8, 2 * radius}, .high = {0.3, 1.8, 1.3}}, concrete);
  add_cone(
      mesh, frame,
      {.from = {-2, 0, radius}, .to = {0, 0, radius}, .radius_from = radius, .radius_to = radius},
      concrete);
}

void furnish_dam(Mesh& mesh, const Road& road, const Ground& ground) {
  const EdgeRow& row = road.side(road.dam_side);
  for (std::size_t block = 0; block < row.blocks.size(); ++block) {
    const double begin = row.begin_of(block) + blend;
    const double end = begin + block_length - 2 * blend;
    if (end > half_length || begin < -half_length) continue;
    const double y = road.dam_side * (road.edge() - 0.45);
    if (road.furnished[block] == Furnished::railed) {
      add_guard_rail(mesh, y, {begin, end}, [&](double x, double t, double z) {
        return Vector3{x, t, ground.height(x, t) + z};
      });
    } else if (road.furnished[block] == Furnished::culvert) {
      add_culvert(mesh, road, ground, (begin + end) / 2);
    }
  }
}

Mesh furnish_embankment(const Road& road, const Ground& ground, Random random) {
  Mesh mesh;
  furnish_dam(mesh, road, ground);
  for (double x = -100 + random.uniform(0, 12); x < 100; x += 12.5) {
    for (const double side : {-1.0, 1.0}) {
      const double y = side * (road.half_road + 0.5);
      add_delineator(mesh, upright_frame({x, y, ground.height(x, y)}, 0));
    }
  }
  const WindingPath centre;
  const auto grow = [&](double per_square_metre, Interval from_centre, auto plant) {
    scatter(centre, {.from_path = from_centre}, per_square_metre, random,
            [&](double x, double y) { plant(mesh, ground, x, y, random); });
  };
  const double edge = road.edge();
  grow(0.003, {20, 60}, add_tree);
  grow(0.012, {edge + 3.5, 40}, add_bush);
  grow(0.5, {edge + 0.1, 18}, add_tuft);
  grow(0.015, {edge + 1.6, 25}, add_ground_cover);
  // High grass at the base of the dam, along the ditch.
  const double foot = edge + road.measures.run * road.measures.dam;
  for (double x = -50; x < 50; x += random.uniform(4, 12)) {
    add_high_grass(mesh, ground,
                   {.x = x,
                    .y = road.dam_side * (foot + random.uniform(3.5, 6)),
                    .radius = random.uniform(1, 2.2),
                    .height = random.uniform(0.4, 0.8)},
                   random);
  }
  return mesh;
}

// Oncoming cars.
Traffic draw_traffic(double lane, std::vector<Stop> route, Random& random) {
  Traffic traffic(std::move(route));
  constexpr double end_of_road = half_length - 5;
  traffic.fill(
      {.path = [lane](double x) { return Stop{.x = x, .y = lane, .yaw = 0}; },
       .speed = -random.uniform(9, 14),
       .x = {-end_of_road, end_of_road},
       .gap = {10, 45}},
      [](Random&) { return RoadUser::car; }, random);
  return traffic;
}

}  // namespace

Landscape embankment(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  const std::shared_ptr<const Road> road = draw_road(random);
  const double lane = road->lane();
  std::vector<Stop> route =
      wander_along([&](double x) { return Stop{.x = x, .y = -lane, .yaw = 0}; }, random);
  std::vector<GroundStep> known = road->side(-1).steps(-1);
  std::ranges::copy(road->side(1).steps(1), std::back_inserter(known));
  Traffic traffic = draw_traffic(lane, route, random);
  return {.ground = make_road(*road),
          .route = std::move(route),
          .furnish =
              [road, random](const Ground& on, const Stretch& /*whole*/) {
                return furnish_embankment(*road, on, random);
              },
          .steps = std::move(known),
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
