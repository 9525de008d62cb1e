// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/street_plan.hpp"

#include <cstddef>
#include <numbers>

namespace flagstone::sim {
namespace {

StreetSide plan_side(Random& random, bool parking) {
  StreetSide side;
  side.parking_width = parking ? random.uniform(2, 2.3) : 0;
  side.kerb_height = random.uniform(0.07, 0.14);
  side.sidewalk_width = random.uniform(1.6, 2.8);
  side.land_slope = random.uniform(-0.03, 0.06);
  side.bank_height = random.chance(0.4) ? random.uniform(0.2, 0.8) : 0;
  return side;
}

StreetShape plan_shape(Random& random) {
  StreetShape shape;
  shape.half_width = random.uniform(2.9, 3.7);
  shape.grade = random.uniform(-0.03, 0.03);
  const double steeper = random.uniform(0.02, 0.07);
  const double change = random.chance(0.5) ? steeper : -steeper;
  shape.grade_changes = {{.change = change, .x = random.uniform(20, 45)}};
  shape.bend_amplitude = random.uniform(-3, 3);
  shape.crown = random.uniform(0.04, 0.09);
  shape.cross_fall = random.uniform(-0.02, 0.02);
  const bool parking_left = random.chance(0.6);
  shape.sides[static_cast<std::size_t>(Side::left)] = plan_side(random, parking_left);
  shape.sides[static_cast<std::size_t>(Side::right)] =
      plan_side(random, !parking_left || random.chance(0.5));
  for (int wave = 0; wave < 3; ++wave) {
    Undulation undulation;
    undulation.amplitude = random.uniform(0.03, 0.08);
    undulation.wave_x = 2 * std::numbers::pi / random.uniform(9, 25);
    undulation.wave_y = 2 * std::numbers::pi / random.uniform(9, 25);
    undulation.phase = random.uniform(0, 2 * std::numbers::pi);
    shape.undulations.push_back(undulation);
  }
  return shape;
}

Plot plan_plot(Random& random, Side side, double x_begin) {
  Plot plot;
  plot.side = side;
  plot.house.width = random.uniform(8, 16);
  plot.house.depth = random.uniform(8, 11);
  plot.house.eaves = random.uniform(3.2, 8.5);
  plot.x_begin = x_begin;
  plot.x_end = x_begin + plot.house.width;
  plot.setback = random.uniform(2.5, 9);
  plot.built = random.chance(0.75);
  const double drawn = random.uniform();
  if (drawn < 0.3) {
    plot.boundary = Boundary::fence;
  } else if (drawn < 0.6) {
    plot.boundary = Boundary::hedge;
  }
  return plot;
}

}  // namespace

StreetPlan plan_street(Random& random) {
  StreetPlan plan{.shape = plan_shape(random), .plots = {}, .furnishing = {}};
  for (const Side side : {Side::right, Side::left}) {
    double x = -plan.shape.half_length + random.uniform(5, 15);
    while (x < plan.shape.half_length - 25) {
      const Plot plot = plan_plot(random, side, x);
      const double gap = random.uniform(3, 9);
      plan.plots.push_back(plot);
      x = plot.x_end + gap;
      if (random.chance(0.6)) {
        plan.shape.sides[static_cast<std::size_t>(side)].driveways.push_back(
            {.x = plot.x_end + gap / 2, .width = 2.6});
      }
    }
  }
  return plan;
}

}  // namespace flagstone::sim
