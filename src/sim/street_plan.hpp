// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "sim/house.hpp"
#include "sim/random.hpp"
#include "sim/street_shape.hpp"

namespace flagstone::sim {

/// What separates a front garden from the sidewalk.
enum class Boundary : std::uint8_t { open, fence, hedge };

/// A house and its front garden, or a green without a house. The gap to the next plot lies beyond
/// x_end.
struct Plot {
  Side side = Side::right;
  double x_begin = 0, x_end = 0;  ///< metres along the street
  double setback = 4;             ///< from the sidewalk to the front wall, metres
  bool built = true;              ///< has the house; a green has trees and bushes instead
  House house;
  Boundary boundary = Boundary::open;
};

/// A street as drawn before it is built: the ground's shape, who lives where.
struct StreetPlan {
  StreetShape shape;
  std::vector<Plot> plots;
};

/// Draws a residential street: slope, cross-fall, kerbs, parking strips, houses with gaps and
/// driveways.
StreetPlan plan_street(Random& random);

}  // namespace flagstone::sim
