// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <numbers>
#include <utility>

#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {
namespace {

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
