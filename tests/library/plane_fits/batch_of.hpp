// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "library/plane_fits/bin_batch.hpp"

namespace flagstone::tests {

/// A batch of up to sixteen bins with these heights, metres; at least one point per bin, heights
/// from -900 m to 900 m. x and y are random in one sixteenth of a circle, 5 to 10 m from the
/// sensor.
plane_fits::BinBatch batch_of(const std::vector<std::vector<float>>& heights);

}  // namespace flagstone::tests
