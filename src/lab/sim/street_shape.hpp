// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::sim {

/// The two sides of a street, seen by who drives along +x.
enum class Side : std::uint8_t { right = 0, left = 1 };

/// +1 for left, where t grows, -1 for right.
constexpr double sign(Side side) noexcept { return side == Side::left ? 1 : -1; }

/// A place where the kerb is lowered and a paved way crosses to the houses.
struct Driveway {
  double x = 0;      ///< centre, metres along the street
  double width = 3;  ///< metres
};

/// One side of a street, from the carriageway outward. Lengths in metres.
struct StreetSide {
  double parking_width = 0;  ///< strip for parked cars between carriageway and kerb; 0 for none
  double kerb_height = 0.12;
  double sidewalk_width = 2;
  double land_slope = 0;   ///< of the land behind the sidewalk, metres a metre outward
  double bank_height = 0;  ///< an embankment that starts at the sidewalk; below 0 a slope down
  std::vector<Driveway> driveways;
};

/// A gentle wave of the land behind the sidewalks.
struct Undulation {
  double amplitude = 0;           ///< metres
  double wave_x = 0, wave_y = 0;  ///< radians a metre
  double phase = 0;               ///< radians
};

/// A vertical curve: where the grade along the street turns into another.
struct GradeChange {
  double change = 0;  ///< added to the grade beyond x, metres a metre
  double x = 40;      ///< where half of the change is done, metres
  double length = 8;  ///< how softly: half of it within about this length, metres
};

/// How wide a zebra crossing is along the street, metres.
inline constexpr double crossing_width = 3.5;

/// Everything that makes the ground of a street. The road runs along x and drives on the right; t
/// is measured across from its centre line, to the left.
struct StreetShape {
  double half_length = 110;  ///< the ground covers x from -half_length to half_length
  double half_width = 3.2;   ///< of the carriageway
  double land_width = 40;    ///< behind each sidewalk

  double grade = 0;                        ///< climb before all changes, metres a metre
  std::vector<GradeChange> grade_changes;  ///< in any order
  double bend_amplitude = 0;               ///< the centre line swings this far to the left
  double bend_length = 150;                ///< and back, once in this length

  double crown = 0.06;    ///< how much higher the middle of the carriageway is than its edge
  double cross_fall = 0;  ///< tilt of the whole street, metres a metre to the left
  double marking_width = 0.12;

  std::array<StreetSide, 2> sides;  ///< indexed by Side
  std::vector<Undulation> undulations;
  std::vector<double> crossings;  ///< middles of zebra crossings, where both kerbs are low, metres
  bool paved_land = false;        ///< slabs behind the sidewalks, not lawn

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

  /// y of the centre line at x, metres.
  [[nodiscard]] double centre_line(double x) const noexcept;

  /// Direction of the street at x, radians from the x axis.
  [[nodiscard]] double heading(double x) const noexcept;

  /// Height of the ground at x, t metres left of the centre line.
  [[nodiscard]] double height(double x, double t) const noexcept;

  /// What the ground is made of there.
  [[nodiscard]] Surface surface(double x, double t) const noexcept;
};

/// The shape cut into a grid whose lines follow kerbs, markings and driveways.
Ground make_ground(const StreetShape& shape);

}  // namespace flagstone::sim
