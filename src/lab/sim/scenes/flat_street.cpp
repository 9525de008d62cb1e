// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <utility>

#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {

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

}  // namespace flagstone::sim
