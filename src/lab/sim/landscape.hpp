// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "lab/sim/ground.hpp"
#include "lab/sim/ground_step.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// A world before anything stands on it. Its ground is quick to make and enough to know every pose;
/// what stands on it takes longer and is made where it is asked for.
struct Landscape {
  Ground ground;
  std::vector<Stop> route;
  std::function<Mesh(const Ground&)> furnish;  ///< the same mesh on every call
  std::vector<GroundStep> steps{};             ///< those that are known, of scenes that list them

  /// What moves: traffic and people as they are at the stop of this number, the same mesh on every
  /// call. Empty where nothing moves.
  std::function<Mesh(const Ground&, int stop)> moving{};
};

}  // namespace flagstone::sim
