// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sim/scan.hpp"

namespace flagstone::sim {

/// One scan of a random street as an HDL-64E on a car in the right-hand lane takes it, with the
/// default noise: some 120,000 points. The same seed gives the same bytes.
SimulatedScan simulate_street(std::uint64_t seed, unsigned threads = 1);

}  // namespace flagstone::sim
