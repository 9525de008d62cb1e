// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// The line of a road in plan: straight at x = 0, into a curve whose curvature grows evenly, as
/// drivers turn the wheel, from `begin` on over `ramp` metres.
class RoadCurve {
 public:
  /// `curvature` in radians a metre, to the left; covers x from -half_length to half_length.
  RoadCurve(double half_length, double curvature, double begin, double ramp);

  /// Where the line is at x, and its direction.
  [[nodiscard]] Stop at(double x) const noexcept;

  /// How much of the curve's curvature the line has at x, 0..1.
  [[nodiscard]] double share(double x) const noexcept;

 private:
  double half_length_, begin_, ramp_;
  std::vector<Stop> line_;  // a metre apart
};

}  // namespace flagstone::sim
