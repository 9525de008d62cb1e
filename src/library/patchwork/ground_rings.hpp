// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "flagstone/sensor.hpp"

namespace flagstone {

/// A ring around a sensor, and the points that it has on flat ground there.
struct GroundRing {
  double inner = 0;   ///< metres
  double outer = 0;   ///< metres
  int beams = 0;      ///< that meet flat ground between them; 0 beyond the last
  double points = 0;  ///< in one full turn; of one beam beyond the last

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

  /// How far the beams meet ground that rises by `slope`, metres a metre, up to the sensor's range;
  /// metres.
  [[nodiscard]] double reach(double slope) const noexcept;

  /// Points of a beam in a full turn; a narrow field of view holds its share of them.
  [[nodiscard]] double points_a_turn() const noexcept { return points_a_turn_; }

 private:
  std::vector<double> radii_;
  double least_fall_ = 0;  ///< of the flattest beam, metres a metre; negative where it rises
  double height_ = 0;
  double max_range_ = 0;
  double points_a_turn_ = 0;
};

/// How long rings are to be.
struct RingLengths {
  double first = 0;     ///< shortest length of the first ring, metres
  double shortest = 0;  ///< of the others, metres
  double one_beam = 0;  ///< of rings that hold one beam only, metres
  double growth = 0;    ///< of the others as a share of the distance of their middle
  double beyond = 0;    ///< of rings beyond the last beam, as a share of the distance they begin at
};

/// Rings from `begin` metres outward, each as short as `lengths` allow: while beams meet flat
/// ground, edges halfway between them and no ring without one; then rings up to `reach` metres, for
/// ground that rises. Empty where no beam meets flat ground beyond `begin`.
std::vector<GroundRing> ground_rings(const GroundBeams& beams, double begin, double reach,
                                     const RingLengths& lengths);

}  // namespace flagstone
