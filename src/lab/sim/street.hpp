// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lab/sim/buildings.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/street_shape.hpp"
#include "library/core/random.hpp"

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

/// How parked cars stand.
enum class Parking : std::uint8_t {
  along,  ///< one behind the other, in the strip's direction
  bays,   ///< side by side, at right angles to the street
};

/// How much of what stands on a street.
struct Furnishing {
  /// @name Gardens and greens: plants a square metre
  /// @{
  double trees = 0.02;
  double bushes = 0.07;
  Interval tufts{0, 4};     ///< every plot draws its own
  double ground_cover = 0;  ///< patches of low growth
  /// @}

  double occupied = 0.7;             ///< share of the parking places that are taken
  Interval parking_gap{0.5, 1.5};    ///< between places along the strip, metres
  std::array<Parking, 2> parking{};  ///< indexed by Side

  bool traffic = true;        ///< cars on the carriageway
  double free_lane = 0;       ///< no car on the right-hand lane for |x| below this, metres
  double path = -1.6;         ///< the line the sensor drives along, metres left of the centre line
  double crown_distance = 0;  ///< trees nearer to that line than this are left out, metres
};

/// A street as drawn before it is built: the ground's shape, who lives where, how much stands
/// there.
struct StreetPlan {
  StreetShape shape;
  std::vector<Plot> plots;
  Furnishing furnishing;
};

/// Draws a residential street: slope, cross-fall, kerbs, parking strips, houses with gaps and
/// driveways.
StreetPlan plan_street(Random& random);

/// A residential street drawn from a seed: houses, gardens with fences, hedges, trees and tufts,
/// parked and moving cars, lamp posts, traffic signs, people. Around x = 0 the lane of who drives
/// along +x is free.
Scene make_street(std::uint64_t seed);

/// A drive along the path of a plan, whose lane it clears of cars and of crowns of trees.
Landscape drive_street(StreetPlan plan, Random random);

/// What stands on the ground of a plan.
Mesh furnish(const StreetPlan& plan, const Ground& ground, Random& random);

}  // namespace flagstone::sim
