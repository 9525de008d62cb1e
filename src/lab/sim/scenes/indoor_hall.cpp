// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/furniture.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/goods.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street_shape.hpp"
#include "lab/sim/traffic.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

constexpr double half_turn = std::numbers::pi;
constexpr double half_length = 55;  // to the end walls, metres
constexpr double dock_drop = 1.1;   // from the floor to the yard in front of the dock
constexpr double dock_face = 0.1;   // thickness of the wall that hides the face of the drop
constexpr double yard_width = 20;
constexpr double line_width = 0.12;
constexpr double rack_gap = 3.2;  // between rows

constexpr Surface yard{.semantic = SemanticClass::other_ground, .reflectivity = 0.25F};
constexpr Surface paint{.semantic = SemanticClass::lane_marking, .reflectivity = 0.6F};
constexpr Surface panel{.semantic = SemanticClass::building, .reflectivity = 0.45F};
constexpr Surface concrete{.semantic = SemanticClass::building, .reflectivity = 0.35F};
constexpr Surface steel{.semantic = SemanticClass::other_structure, .reflectivity = 0.3F};

enum class Use { racks_along, racks_across, staging, dock };

// A hall with an aisle along x in its middle, which is the path of the sensor.
struct Hall {
  double half_aisle;
  double height;  // of the roof
  double column_pitch;
  double fall_x, fall_y;        // slopes of the floor, m/m
  double gloss;                 // specular reflection of the floor, see Surface::mirror
  std::array<Use, 2> uses;      // of the right and the left half
  std::array<double, 2> reach;  // from the middle of the aisle to the walls
  double dock;                  // from the middle of the aisle to the edge of a dock

  [[nodiscard]] bool drops(double y) const noexcept {
    return uses[y > 0] == Use::dock && std::abs(y) > dock;
  }
  [[nodiscard]] double ground(double x, double y) const noexcept {
    return fall_x * x + fall_y * y - (drops(y) ? dock_drop : 0);
  }
  [[nodiscard]] Surface surface(double y) const noexcept {
    if (drops(y)) return yard;
    if (std::abs(std::abs(y) - half_aisle) < line_width / 2) return paint;
    return {.semantic = SemanticClass::other_ground,
            .reflectivity = 0.35F,
            .mirror = static_cast<float>(gloss)};
  }
};

Hall draw_hall(Random& random) {
  Hall hall{.half_aisle = random.uniform(4.6, 5.8),
            .height = random.uniform(7.5, 11),
            .column_pitch = random.uniform(9, 12),
            .fall_x = random.uniform(-0.004, 0.004),
            .fall_y = random.uniform(-0.003, 0.003),
            .gloss = random.uniform(0.08, 0.3),
            .uses = {},
            .reach = {},
            .dock = random.uniform(8, 12)};
  for (const std::size_t side : {0U, 1U}) {
    const double drawn = random.uniform();
    hall.uses[side] = drawn < 0.3   ? Use::racks_along
                      : drawn < 0.6 ? Use::racks_across
                      : drawn < 0.8 ? Use::staging
                                    : Use::dock;
    hall.reach[side] =
        hall.uses[side] == Use::dock ? hall.dock + yard_width : random.uniform(16, 28);
  }
  return hall;
}

Ground make_floor(const Hall& hall) {
  GroundPlan plan{.x = {},
                  .t = {},
                  .offset = [](double) { return 0.0; },
                  .height = [&](double x, double y) { return hall.ground(x, y); },
                  .surface = [&](double, double y) { return hall.surface(y); }};
  constexpr double below_walls = 0.3;
  constexpr double face = 0.02;  // width over which the floor drops, metres
  add_lines(plan.x, -half_length - below_walls, half_length + below_walls, 1);
  add_lines(plan.t, -hall.reach[0] - below_walls, hall.reach[1] + below_walls, 1);
  for (const double side : {-1.0, 1.0}) {
    plan.t.push_back(side * (hall.half_aisle - line_width / 2));
    plan.t.push_back(side * (hall.half_aisle + line_width / 2));
    if (hall.uses[side > 0] != Use::dock) continue;
    plan.t.push_back(side * hall.dock);
    plan.t.push_back(side * (hall.dock + face));
  }
  finish_lines(plan.t);
  return cut_ground(std::move(plan));
}

// Adds objects to a hall. `side` is -1 for its right half, +1 for its left half.
class Furnisher {
 public:
  Furnisher(const Hall& hall, const Ground& ground, Random& random)
      : hall_(hall), ground_(ground), random_(random) {
    build_shell();
    for (const double side : {-1.0, 1.0}) {
      switch (hall.uses[side > 0]) {
        case Use::racks_along: rack_along(side); break;
        case Use::racks_across: rack_across(side); break;
        case Use::staging: stage(side, hall.reach[side > 0] - 1); break;
        case Use::dock: build_dock(side); break;
      }
      leave_things(side);
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  [[nodiscard]] Frame upright(double x, double y, double yaw) const {
    return upright_frame({x, y, ground_.height(x, y)}, yaw);
  }

  void block(Interval x, Interval y, Interval z, Surface surface) {
    add_box(mesh_, Frame{}, {.low = {x.low, y.low, z.low}, .high = {x.high, y.high, z.high}},
            surface);
  }

  void build_shell() {
    constexpr double thick = 0.25;
    constexpr double below = dock_drop + 0.6;
    const Interval across{-hall_.reach[0] - thick, hall_.reach[1] + thick};
    const Interval along{-half_length - thick, half_length + thick};
    const Interval wall{-below, hall_.height};
    for (const double x : {-half_length - thick, half_length}) {
      block({x, x + thick}, across, wall, panel);
    }
    block(along, {across.low, across.low + thick}, wall, panel);
    block(along, {across.high - thick, across.high}, wall, panel);
    block(along, across, {hall_.height, hall_.height + 0.2}, panel);
    for (double x = -half_length + 3; x < half_length; x += hall_.column_pitch / 2) {
      block({x - 0.12, x + 0.12}, across, {hall_.height - 0.7, hall_.height}, steel);
      for (const double y : {-hall_.half_aisle / 2, hall_.half_aisle / 2}) {
        block({x + 1, x + 2.2}, {y - 0.1, y + 0.1}, {hall_.height - 1.1, hall_.height - 0.95},
              steel);
      }
    }
    for (double x = -half_length + 3; x < half_length; x += hall_.column_pitch) {
      for (const double side : {-1.0, 1.0}) {
        const double y = side * (hall_.half_aisle + 0.35);
        block({x - 0.2, x + 0.2}, {y - 0.2, y + 0.2}, {-below, hall_.height}, concrete);
      }
    }
  }

  void rack_along(double side) {
    const int bays = static_cast<int>((2 * half_length - 12) / rack_bay);
    const Rack rack{.bays = bays, .levels = static_cast<int>(hall_.height / 2) - 1};
    double out = hall_.half_aisle + 1.4;
    while (out < hall_.reach[side > 0] - 1.5) {
      add_rack(mesh_, upright(-half_length + 6, side * out, 0), rack, random_);
      const double back_to_back = out + rack_depth + 0.15;
      if (back_to_back < hall_.reach[side > 0] - 1.5) {
        add_rack(mesh_, upright(-half_length + 6, side * back_to_back, 0), rack, random_);
      }
      out = back_to_back + rack_depth + rack_gap;
    }
  }

  void rack_across(double side) {
    const double begin = hall_.half_aisle + 1;
    const int bays = static_cast<int>((hall_.reach[side > 0] - begin - 2.5) / rack_bay);
    if (bays < 1) return;
    const Rack rack{.bays = bays, .levels = static_cast<int>(hall_.height / 2) - 1};
    for (double x = -half_length + 5; x < half_length - 4; x += 2 * rack_depth + 0.15 + rack_gap) {
      for (const double row : {0.0, rack_depth + 0.15}) {
        add_rack(mesh_, upright(x + row, side * begin, side * half_turn / 2), rack, random_);
      }
    }
  }

  // Pallets in irregular rows on the floor, up to `reach` from the middle.
  void stage(double side, double reach) {
    for (double x = -half_length + 4; x < half_length - 4; x += random_.uniform(1.4, 5)) {
      for (double out = hall_.half_aisle + 1.4; out < reach - 1; out += random_.uniform(1, 3.5)) {
        if (random_.chance(0.45)) continue;
        const double load = random_.chance(0.3) ? 0 : random_.uniform(0.1, 1.6);
        add_pallet(mesh_, upright(x, side * out, random_.uniform(-0.05, 0.05)), load, random_);
      }
    }
  }

  void build_dock(double side) {
    const double edge = side * hall_.dock;
    const double outer = side * (hall_.dock + dock_face);
    // A wall around the face of the drop, just below the floor.
    constexpr double piece = 5;
    for (double x = -half_length; x < half_length; x += piece) {
      const double floor = std::min(hall_.ground(x, edge), hall_.ground(x + piece, edge));
      block({x, x + piece}, {std::min(edge, outer), std::max(edge, outer)},
            {floor - dock_drop - 0.3, floor - 0.03}, concrete);
    }
    stage(side, hall_.dock - 1);
    for (double x = -half_length + 6; x < half_length - 4; x += random_.uniform(4, 8)) {
      add_bollard(mesh_, upright(x + 2, edge - side * 0.3, 0));
      if (!random_.chance(0.45)) continue;
      // A truck backed up to the dock.
      const double y = side * (hall_.dock + dock_face + 0.15 + truck_length / 2);
      add_truck(mesh_, upright(x, y, side * half_turn / 2), random_);
    }
  }

  // Low objects next to the path of the sensor.
  void leave_things(double side) {
    for (double x = -half_length + 8; x < half_length - 8; x += random_.uniform(5, 16)) {
      const double drawn = random_.uniform();
      const double y = side * random_.uniform(2.2, 2.8);
      const Frame frame = upright(x, y, random_.uniform(-0.2, 0.2));
      if (drawn < 0.4) {
        add_pallet(mesh_, frame, 0, random_);
      } else if (drawn < 0.6) {
        add_pallet(mesh_, frame, random_.uniform(0.1, 0.5), random_);
      } else if (drawn < 0.8) {
        add_pallet_truck(mesh_, frame);
      } else {
        add_bin(mesh_, frame);
      }
    }
  }

  const Hall& hall_;
  const Ground& ground_;
  Random& random_;
  Mesh mesh_;
};

Traffic send_traffic(const Hall& hall, const std::vector<Stop>& route, Random& random) {
  const Path middle = [](double x) { return Stop{.x = x, .y = 0, .yaw = 0}; };
  Traffic traffic(route);
  traffic.join({.kind = RoadUser::forklift,
                .at = along(middle, 0, -half_drive + random.uniform(11, 20), own_speed),
                .look = random.bits()});
  // Traffic along the edges of the aisle, and across its end.
  const auto either = [&] { return random.chance(0.5) ? 1.0 : -1.0; };
  for (int forklift = 0; forklift < 6; ++forklift) {
    traffic.join({.kind = RoadUser::forklift,
                  .at = along(middle, 3.95 * either(), random.uniform(-42, 42),
                              either() * random.uniform(0.5, 2.5)),
                  .look = random.bits()});
  }
  const double side = either();
  traffic.join({.kind = RoadUser::forklift,
                .at = straight({.x = random.uniform(42, 46),
                                .y = side * (hall.half_aisle - 2),
                                .yaw = -side * half_turn / 2},
                               random.uniform(0.4, 1), 2 * hall.half_aisle - 4),
                .look = random.bits()});
  for (int person = 0; person < 14; ++person) {
    traffic.join({.kind = RoadUser::person,
                  .at = along(middle, either() * random.uniform(3.7, 4.1), random.uniform(-42, 42),
                              either() * random.uniform(0.6, 1.6)),
                  .look = random.bits()});
  }
  return traffic;
}

}  // namespace

Landscape indoor_hall(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  const Hall hall = draw_hall(random);
  std::vector<Stop> route =
      wander_along([](double x) { return Stop{.x = x, .y = 0, .yaw = 0}; }, random);
  Traffic traffic = send_traffic(hall, route, random);
  return {.ground = make_floor(hall),
          .route = std::move(route),
          .furnish =
              [hall, random](const Ground& on, const Stretch& /*whole*/) {
                Random own = random;
                return Furnisher(hall, on, own).take();
              },
          .moving = moving(std::move(traffic))};
}

}  // namespace flagstone::sim
