// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace flagstone::performance {

/// Numbers from 0 to `count` in an order that makes std::nth_element of this standard library,
/// asked for one of the lowest, the `nth`, work hard. Where `fixed(i)` the number is `count`, the
/// greatest.
///
/// M. D. McIlroy, "A Killer Adversary for Quicksort", Software: Practice and Experience 29(4),
/// 1999: numbers are decided while they are being compared, here each time so that the pivot is
/// high and next to nothing is left out for the next round.
std::vector<double> adverse_to_selection(std::size_t count, std::size_t nth,
                                         bool (*fixed)(std::size_t));

}  // namespace flagstone::performance
