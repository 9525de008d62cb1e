// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lab/sim/buildings.hpp"
#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/street_shape.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Boundary between a front garden and the sidewalk.
enum class Boundary : std::uint8_t { open, fence, hedge };

/// A house and its front garden, or a green without a house. The gap to the next plot is beyond
/// x_end.
struct Plot {
  Side side = Side::right;
  double x_begin = 0, x_end = 0;  ///< metres along the street
  double setback = 4;             ///< from the sidewalk to the front wall, metres
  bool built = true;              ///< has a house; otherwise a green with trees and bushes
  House house;
  Boundary boundary = Boundary::open;
};

/// Arrangement of parked cars.
enum class Parking : std::uint8_t {
  along,  ///< one behind the other, in the direction of the strip
  bays,   ///< side by side, at right angles to the street
};

/// Number and kind of objects on a street.
struct Furnishing {
  /// @name Gardens and greens: plants per square metre
  /// @{
  double trees = 0.02;
  double bushes = 0.07;
  Interval tufts{0, 4};     ///< drawn for each plot
  double ground_cover = 0;  ///< patches of low vegetation
  /// @}

  double occupied = 0.7;             ///< fraction of the parking spaces that are occupied
  Interval parking_gap{0.5, 1.5};    ///< between parking spaces along the strip, metres
  std::array<Parking, 2> parking{};  ///< indexed by Side

  bool traffic = true;        ///< cars on the carriageway
  double free_lane = 0;       ///< no car on the right-hand lane for |x| below this, metres
  double path = -1.6;         ///< path of the sensor, metres left of the centre line
  double crown_distance = 0;  ///< trees closer to the path than this are omitted, metres
};

/// The random plan of a street: shape of the ground, plots, and number of objects.
struct StreetPlan {
  StreetShape shape;
  std::vector<Plot> plots;
  Furnishing furnishing;
  Extent extent;
};

/// Draws the plan of a residential street: slope, cross-fall, kerbs, parking strips, houses with
/// gaps and driveways.
StreetPlan plan_street(Random& random, const Extent& extent = {});

/// A random residential street: houses, gardens with fences, hedges, trees and tufts, parked and
/// moving cars, lamp posts, traffic signs, people. Around x = 0 the lane in the direction +x is
/// free.
Scene make_street(std::uint64_t seed);

/// A landscape with a route along the path of a plan. The lane of the path has no cars and no tree
/// crowns.
Landscape drive_street(StreetPlan plan, Random random);

/// The objects on the ground of a plan, on one of its stretches.
Mesh furnish(const StreetPlan& plan, const Ground& ground, const Stretch& stretch, Random& random);

}  // namespace flagstone::sim
