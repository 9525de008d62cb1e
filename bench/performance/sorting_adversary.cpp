// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sorting_adversary.hpp"

#include <algorithm>
#include <numeric>

namespace flagstone::performance {

std::vector<double> adverse_to_selection(std::size_t count, std::size_t nth,
                                         bool (*fixed)(std::size_t)) {
  const auto greatest = static_cast<double>(count);
  constexpr double undecided = 0;
  std::vector<double> numbers(count, undecided);
  for (std::size_t i = 0; i < count; ++i) {
    if (fixed(i)) numbers[i] = greatest;
  }
  double next = greatest - 1;
  std::size_t candidate = 0;  // an undecided number that is probably the pivot
  const auto less = [&](std::size_t a, std::size_t b) {
    if (numbers[a] == undecided && numbers[b] == undecided) {
      numbers[a == candidate ? a : b] = next--;
    }
    if (numbers[a] == undecided) candidate = a;
    if (numbers[b] == undecided) candidate = b;
    return numbers[a] < numbers[b];
  };
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::nth_element(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(nth), places.end(),
                   less);
  return numbers;
}

}  // namespace flagstone::performance
