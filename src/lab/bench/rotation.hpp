// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace flagstone::bench {

/// In which order the contestants 0 to `contestants` - 1 go in this round: each begins in turn, and
/// every other round goes backwards, so that none always follows the same one.
[[nodiscard]] std::vector<std::size_t> order_of_round(std::size_t contestants, std::size_t round);

}  // namespace flagstone::bench
