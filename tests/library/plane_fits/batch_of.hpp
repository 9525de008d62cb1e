// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::tests {

/// A batch of up to sixteen bins of 1 to many points with these heights, metres, above and below
/// which nothing but +-900 m is. Their x and y are at random places of one sixteenth of a circle, 5
/// to 10 m from the sensor.
plane_fits::BinBatch batch_of(const std::vector<std::vector<float>>& heights);

}  // namespace flagstone::tests
