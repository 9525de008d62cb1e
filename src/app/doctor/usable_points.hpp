// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "files/io/cloud.hpp"
#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// The points of a scan that have a place, in their order, and what the others are.
struct UsablePoints {
  std::vector<Vector3f> places;  ///< as the file has them: its units, its axes
  std::vector<int> rings;        ///< of each place, from a field of that name; empty without

  std::size_t given = 0;       ///< points of the scan
  std::size_t zero = 0;        ///< all three coordinates are zero: no echo
  std::size_t not_finite = 0;  ///< a coordinate is NaN or infinite
  std::size_t repeated = 0;    ///< usable, with the coordinates of another usable one before it
};

/// Sorts out the points of a scan. A field `ring` is believed if it holds 2 to 1,024 different
/// whole numbers.
UsablePoints usable_points(const io::Cloud& cloud);

}  // namespace flagstone::doctor
