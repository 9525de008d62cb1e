// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <utility>

#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {
namespace {

// A grade of 10 to 25 %, then others, of which more than half go the other way, so that crests and
// sags lie close enough to be seen.
void draw_profile(StreetShape& shape, Random& random) {
  const auto steep = [&] { return random.uniform(0.1, 0.25); };
  double direction = random.chance(0.5) ? 1 : -1;
  double grade = direction * steep();
  shape.grade = grade;
  shape.grade_changes.clear();
  double x = random.uniform(-75, -40);
  while (x < shape.half_length) {
    if (random.chance(0.6)) direction = -direction;
    const double next = direction * steep();
    shape.grade_changes.push_back(
        {.change = next - grade, .x = x, .length = random.uniform(2.5, 7)});
    grade = next;
    x += random.uniform(30, 60);
  }
}

}  // namespace

Landscape steep_street(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random);
  draw_profile(plan.shape, random);
  const Side uphill = random.chance(0.5) ? Side::left : Side::right;
  for (const Side which : {Side::right, Side::left}) {
    StreetSide& side = plan.shape.sides[static_cast<std::size_t>(which)];
    // Even slopes begin at the sidewalk: a hillside that is cut by the street.
    side.land_slope = which == uphill ? random.uniform(0.08, 0.3) : random.uniform(-0.2, -0.05);
    side.bank_height = which == uphill ? random.uniform(0, 0.6) : random.uniform(-1, -0.2);
  }
  // Walls reach down 25 % along and 20 % down the hill, over half of a house's width and its depth.
  for (Plot& plot : plan.plots) plot.house.buried = 6;
  return drive_street(std::move(plan), random);
}

}  // namespace flagstone::sim
