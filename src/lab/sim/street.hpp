// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "lab/sim/landscape.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/street_plan.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// A residential street drawn from a seed: houses, gardens with fences, hedges, trees and tufts,
/// parked and moving cars, lamp posts, traffic signs, people. Around x = 0 the lane of who drives
/// along +x is free.
Scene make_street(std::uint64_t seed);

/// A drive along the path of a plan, whose lane it clears of cars and of crowns of trees.
Landscape drive_street(StreetPlan plan, Random random);

/// What stands on the ground of a plan.
Mesh furnish(const StreetPlan& plan, const Ground& ground, Random& random);

}  // namespace flagstone::sim
