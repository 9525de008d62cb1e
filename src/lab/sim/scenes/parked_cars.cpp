// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <utility>

#include "lab/sim/scenes/scenes.hpp"
#include "lab/sim/street.hpp"

namespace flagstone::sim {

Landscape parked_cars(std::uint64_t seed) {
  Random random = Random::stream(seed, 0);
  StreetPlan plan = plan_street(random);
  plan.shape.half_width = random.uniform(2.2, 2.5);  // one way, without a marking
  plan.shape.marking_width = 0;
  plan.furnishing.path = 0;
  plan.furnishing.traffic = false;
  plan.furnishing.occupied = 0.93;
  for (const std::size_t side : {0U, 1U}) {
    const bool bays = random.chance(0.4);
    plan.furnishing.parking[side] = bays ? Parking::bays : Parking::along;
    plan.shape.sides[side].parking_width = bays ? 4.9 : 2.1;
    // Driveways are gaps in the row: few of them.
    std::erase_if(plan.shape.sides[side].driveways,
                  [&](const Driveway&) { return random.chance(0.7); });
  }
  plan.furnishing.parking_gap = {0.45, 0.85};
  return drive_street(std::move(plan), random);
}

}  // namespace flagstone::sim
