// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <numbers>
#include <utility>

#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {
namespace {

// A grade of 10 to 25 %, followed by others. More than half of the changes reverse the direction,
// so that crests and sags are close enough to be seen.
void draw_profile(StreetShape& shape, Random& random) {
  const auto steep = [&] { return random.uniform(0.1, 0.25); };
  double direction = random.chance(0.5) ? 1 : -1;
  double grade = direction * steep();
  shape.grade = grade;
  shape.grade_changes.clear();
  double x = random.uniform(-75, -40);
  while (x < shape.length.high) {
    if (random.chance(0.6)) direction = -direction;
    const double next = direction * steep();
    shape.grade_changes.push_back(
        {.change = next - grade, .x = x, .length = random.uniform(2.5, 7)});
    grade = next;
    x += random.uniform(30, 60);
  }
}

void draw_lane(StreetShape& shape, Random& random) {
  shape.half_width = random.uniform(1.8, 2.3);
  shape.marking_width = 0;
  for (StreetSide& side : shape.sides) {
    side.parking_width = 0;
    side.kerb_height = random.uniform(0.02, 0.06);
    side.sidewalk_width = random.uniform(0.4, 0.8);
    side.land_slope = random.uniform(-0.06, 0.08);
  }
  for (Undulation& wave : shape.undulations) {
    wave.amplitude = random.uniform(0.05, 0.16);
    wave.wave_x = 2 * std::numbers::pi / random.uniform(6, 20);
    wave.wave_y = 2 * std::numbers::pi / random.uniform(6, 20);
  }
}

}  // namespace

Landscape flat_street(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random);
  plan.shape.grade = random.uniform(-0.01, 0.01);
  plan.shape.grade_changes.clear();
  plan.shape.cross_fall = random.uniform(-0.01, 0.01);
  for (StreetSide& side : plan.shape.sides) {
    side.land_slope = random.uniform(-0.015, 0.015);
    side.bank_height = 0;
  }
  for (Undulation& wave : plan.shape.undulations) wave.amplitude *= 0.4;
  return drive_street(std::move(plan), random);
}

Landscape steep_street(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random);
  draw_profile(plan.shape, random);
  const Side uphill = random.chance(0.5) ? Side::left : Side::right;
  for (const Side which : {Side::right, Side::left}) {
    StreetSide& side = plan.shape.sides[static_cast<std::size_t>(which)];
    // The street is cut into a hillside, with even slopes that start at the sidewalk.
    side.land_slope = which == uphill ? random.uniform(0.08, 0.3) : random.uniform(-0.2, -0.05);
    side.bank_height = which == uphill ? random.uniform(0, 0.6) : random.uniform(-1, -0.2);
  }
  // Deep enough for a slope of 25 % over half the width of a house, and 20 % over its depth.
  for (Plot& plot : plan.plots) plot.house.buried = 6;
  return drive_street(std::move(plan), random);
}

Landscape parked_cars(std::uint64_t seed, const Extent& extent) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random, extent);
  plan.shape.half_width = random.uniform(2.2, 2.5);  // one way, without a marking
  plan.shape.marking_width = 0;
  plan.furnishing.path = 0;
  plan.furnishing.traffic = false;
  plan.furnishing.occupied = 0.93;
  for (const std::size_t side : {0U, 1U}) {
    const bool bays = random.chance(0.4);
    plan.furnishing.parking[side] = bays ? Parking::bays : Parking::along;
    plan.shape.sides[side].parking_width = bays ? 4.9 : 2.1;
    // Driveways are gaps in the row, so keep only a few.
    std::erase_if(plan.shape.sides[side].driveways,
                  [&](const Driveway&) { return random.chance(0.7); });
  }
  plan.furnishing.parking_gap = {0.45, 0.85};
  return drive_street(std::move(plan), random);
}

Landscape bushes_and_lawn(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random);
  draw_lane(plan.shape, random);
  for (Plot& plot : plan.plots) {
    plot.built = random.chance(0.12);
    plot.boundary = random.chance(0.35) ? Boundary::hedge : Boundary::open;
  }
  plan.furnishing = {.trees = 0.012,
                     .bushes = 0.1,
                     .tufts = {0, 5},
                     .ground_cover = 0.05,
                     .traffic = false,
                     .path = 0};
  return drive_street(std::move(plan), random);
}

}  // namespace flagstone::sim
