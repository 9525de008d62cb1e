// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/sensor.hpp"

namespace flagstone {

/// Points that a sensor has on flat ground between two circles around it.
struct GroundRing {
  double inner = 0;   ///< metres
  double outer = 0;   ///< metres
  int beams = 0;      ///< that meet the ground between them
  double points = 0;  ///< in one full turn

  [[nodiscard]] double length() const noexcept { return outer - inner; }
  [[nodiscard]] double middle() const noexcept { return (inner + outer) / 2; }
};

/// Where the beams of a sensor meet flat ground `height` metres below it, and how many points each
/// of them has in a full turn. A rosette counts as beams that share out its points evenly over its
/// field of view.
class GroundBeams {
 public:
  explicit GroundBeams(const Sensor& sensor);

  /// Distances from the point below the sensor, metres, ascending: height / tan(-elevation). Beams
  /// that meet no ground within the sensor's range are not among them.
  [[nodiscard]] const std::vector<double>& radii() const noexcept { return radii_; }

  /// Points of a beam in a full turn; a narrow field of view holds its share of them.
  [[nodiscard]] double points_a_turn() const noexcept { return points_a_turn_; }

 private:
  std::vector<double> radii_;
  double points_a_turn_ = 0;
};

/// How long rings are to be.
struct RingLengths {
  double first = 0;     ///< shortest length of the first ring, metres
  double shortest = 0;  ///< of the others, metres
  double growth = 0;    ///< of the others as a share of the distance of their middle
};

/// Rings from `begin` metres outward, edges halfway between beams, each as short as `lengths` allow
/// and none without a beam. The last one ends half a gap beyond the last beam, at `end` metres at
/// most. Empty where no beam meets the ground beyond `begin`.
std::vector<GroundRing> ground_rings(const GroundBeams& beams, double begin, double end,
                                     const RingLengths& lengths);

}  // namespace flagstone
