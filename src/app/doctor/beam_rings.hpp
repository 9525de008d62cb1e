// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// Where the beam of a point is known from.
enum class RingSource {
  none,
  field,  ///< a field `ring` of the file
  order,  ///< the points are listed ring after ring
};

/// Which beam each point comes from.
struct BeamRings {
  RingSource source = RingSource::none;
  std::vector<int> of_points;  ///< 0 to count - 1; empty if not known
  int count = 0;               ///< beams; 0 if not known
};

/// `places`: z is the axis the sensor turns about. `field`: ring numbers from the file, or empty.
BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field);

}  // namespace flagstone::doctor
