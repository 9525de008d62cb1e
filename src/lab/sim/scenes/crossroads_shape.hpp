// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "lab/sim/ground.hpp"
#include "lab/sim/interval.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {

/// Two crowned roads that cross at the origin, one along x and one along y. Lengths in metres; what
/// is said of one arm holds for its opposite too.
struct CrossroadsShape {
  static constexpr double half_length = 105;  ///< of the road along x
  static constexpr double half_width = 70;    ///< and of that along y
  static constexpr double crossing_width = 3.5;
  static constexpr double island_half_width = 0.9;

  /// One of the roads.
  struct Road {
    double half_width;
    double crown;     ///< how much its middle is higher than its edge
    double grade;     ///< metres a metre
    double sag;       ///< change of the grade, a metre
    Interval island;  ///< reach along it, from the middle of the junction; empty for none
  };
  Road own, side;  ///< along x, along y
  double corner;   ///< radius of the kerb between the two
  double kerb_height;
  double sidewalk;  ///< width
  double island_height;
  Interval bed_x, bed_y;              ///< reach of the flower beds at the corners
  std::array<double, 4> bed_heights;  ///< 0 for none; see quadrant()
  std::array<bool, 4> lawn;           ///< behind the sidewalk, or slabs

  /// 0 where x and y are above 0, then counter-clockwise.
  static std::size_t quadrant(double x, double y) noexcept {
    return y > 0 ? (x > 0 ? 0U : 1U) : (x > 0 ? 3U : 2U);
  }
  /// Where the zebra crossings over a road begin, from the middle of the junction.
  [[nodiscard]] double crossing_begin(const Road& other) const noexcept {
    return other.half_width + corner + 0.5;
  }
  /// To the kerb, above 0 behind it.
  [[nodiscard]] double behind_kerb(double x, double y) const noexcept;

  [[nodiscard]] double height(double x, double y) const noexcept;
  [[nodiscard]] Surface surface(double x, double y) const noexcept;
};

CrossroadsShape draw_crossroads(Random& random);

Ground make_ground(const CrossroadsShape& shape);

}  // namespace flagstone::sim
