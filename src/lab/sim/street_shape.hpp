// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// The two sides of a street, in the direction +x.
enum class Side : std::uint8_t { right = 0, left = 1 };

/// +1 for left (positive t), -1 for right.
constexpr double sign(Side side) noexcept { return side == Side::left ? 1 : -1; }

/// A lowered kerb with a paved way to the houses.
struct Driveway {
  double x = 0;      ///< centre, metres along the street
  double width = 3;  ///< metres
};

/// One side of a street, from the carriageway outward. Lengths in metres.
struct StreetSide {
  double parking_width = 0;  ///< strip for parked cars between carriageway and kerb; 0 for none
  double kerb_height = 0.12;
  double sidewalk_width = 2;
  double land_slope = 0;   ///< of the land behind the sidewalk, m/m outward
  double bank_height = 0;  ///< of an embankment at the sidewalk; negative: a slope down
  std::vector<Driveway> driveways;
};

/// A gentle wave of the land behind the sidewalks.
struct Undulation {
  double amplitude = 0;           ///< metres
  double wave_x = 0, wave_y = 0;  ///< rad/m
  double phase = 0;               ///< radians
};

/// A vertical curve: a change of the grade along the street.
struct GradeChange {
  double change = 0;  ///< added to the grade beyond x, m/m
  double x = 40;      ///< position of half of the change, metres
  double length = 8;  ///< half of the change is within about this length, metres
};

/// Width of a zebra crossing along the street, metres.
inline constexpr double crossing_width = 3.5;

/// All parameters of the ground of a street. The road is along x, with traffic on the right; t is
/// measured to the left of its centre line.
struct StreetShape {
  Interval length{-110, 110};  ///< part of the x axis that the ground covers
  bool closed = false;         ///< see GroundGrid
  double half_width = 3.2;     ///< of the carriageway
  double land_width = 40;      ///< behind each sidewalk

  double grade = 0;                        ///< before all changes, m/m
  std::vector<GradeChange> grade_changes;  ///< in any order
  double bend_amplitude = 0;               ///< swing of the centre line to the left and back
  double bend_length = 150;                ///< wavelength of the swing

  double crown = 0.06;    ///< height of the middle of the carriageway above its edge
  double cross_fall = 0;  ///< tilt of the whole street to the left, m/m
  double marking_width = 0.12;

  std::array<StreetSide, 2> sides;  ///< indexed by Side
  std::vector<Undulation> undulations;
  std::vector<double> crossings;  ///< middles of zebra crossings, which have low kerbs, metres
  bool paved_land = false;        ///< slabs instead of lawn behind the sidewalks

  [[nodiscard]] const StreetSide& side(Side which) const noexcept {
    return sides[static_cast<std::size_t>(which)];
  }

  /// @name Across the street: distances from the centre line, metres
  /// @{
  [[nodiscard]] double kerb(Side which) const noexcept {
    return half_width + side(which).parking_width;
  }
  [[nodiscard]] double sidewalk_begin(Side which) const noexcept;
  [[nodiscard]] double land_begin(Side which) const noexcept {
    return sidewalk_begin(which) + side(which).sidewalk_width;
  }
  [[nodiscard]] double land_end(Side which) const noexcept {
    return land_begin(which) + land_width;
  }
  /// @}

  /// Adapts the shape to an environment. In a long one, the Alignment has the grades, and all
  /// that repeats along a circuit closes on it.
  void extend(const Extent& extent);

  /// y of the centre line at x, metres.
  [[nodiscard]] double centre_line(double x) const noexcept;

  /// Direction of the street at x, radians from the x axis.
  [[nodiscard]] double heading(double x) const noexcept;

  /// Height of the ground at x, t metres left of the centre line.
  [[nodiscard]] double height(double x, double t) const noexcept;

  /// Surface of the ground at x, t metres left of the centre line.
  [[nodiscard]] Surface surface(double x, double t) const noexcept;
};

/// The shape as a grid whose lines follow kerbs, markings and driveways.
Ground make_ground(const StreetShape& shape);

}  // namespace flagstone::sim
