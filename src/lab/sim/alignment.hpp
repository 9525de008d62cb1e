// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/route.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Farthest distance from the road of ground that an alignment can contain, metres. Curves are so
/// wide that the land within it does not overlap.
inline constexpr double alignment_half_width = 76;

/// Length of the shortest circuit, metres.
inline constexpr double shortest_circuit = 700;

/// The line that a long road follows: curves in plan, and grades. Converts road
/// coordinates (x along the road, y to its left, z above it) to the world frame. x = begin() of the
/// extent is at the origin.
///
/// An open line turns to both sides, by up to 50 degrees, with radii of at least 150 m, and never
/// meets itself. A circuit turns by 360 degrees to the left, with two or three narrower curves.
/// Const functions are thread-safe.
class Alignment {
 public:
  /// The length of a circuit must be at least shortest_circuit.
  Alignment(const Extent& extent, Random random);

  [[nodiscard]] const Extent& extent() const noexcept { return extent_; }

  /// Position and heading of the line at x.
  [[nodiscard]] Stop at(double x) const noexcept;

  /// Height of the line at x, metres.
  [[nodiscard]] double height(double x) const noexcept;

  [[nodiscard]] Vector3 to_world(Vector3 road) const noexcept;
  [[nodiscard]] Stop to_world(const Stop& road) const noexcept;

 private:
  struct Wave {
    double amplitude, wave_number, phase;
  };
  [[nodiscard]] double heading(double way) const noexcept;

  Extent extent_;
  double first_;             // x of the first node
  double turn_ = 0;          // of a circuit, rad/m
  std::vector<Wave> bends_;  // of the heading, radians
  std::vector<Wave> hills_;  // of the height, metres
  std::vector<Stop> nodes_;  // 1 m apart
};

}  // namespace flagstone::sim
