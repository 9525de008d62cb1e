// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/rotation.hpp"

namespace flagstone::bench {

std::vector<std::size_t> order_of_round(std::size_t contestants, std::size_t round) {
  std::vector<std::size_t> order(contestants);
  for (std::size_t i = 0; i < contestants; ++i) {
    const std::size_t step = round % 2 == 0 ? i : contestants - i;
    // Two rounds, one each way, begin with the same contestant.
    order[i] = (round / 2 + step) % contestants;
  }
  return order;
}

}  // namespace flagstone::bench
