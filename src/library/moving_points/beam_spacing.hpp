// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "library/moving_points/directions.hpp"

namespace flagstone {

/// The median angle between neighbouring beams of a sensor, from the points of one scan, degrees,
/// 0.35 (a column of a range image) to 2.5. May throw std::bad_alloc.
double measured_beam_spacing(const PointArrays& points);

}  // namespace flagstone
