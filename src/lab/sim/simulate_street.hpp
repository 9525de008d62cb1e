// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lab/sim/scan.hpp"

namespace flagstone::sim {

/// One scan of a random street as an HDL-64E on a car in the right-hand lane takes it, with the
/// default noise: some 120,000 points. The same seed gives the same bytes.
SimulatedScan simulate_street(std::uint64_t seed, unsigned threads = 1);

/// Where the ground of that street truly is at each point of its scan, see true_ground(): metres,
/// sensor frame. `xyzi` are the scan's.
std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi);

}  // namespace flagstone::sim
