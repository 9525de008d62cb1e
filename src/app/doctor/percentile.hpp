// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flagstone::doctor {

/// The value that `percent` (0 to 100) in a hundred of `values` do not exceed: nearest rank. At
/// least one value; their order changes.
template <class T>
T percentile(std::vector<T>& values, double percent) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::ptrdiff_t>(std::lround(last * percent / 100));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace flagstone::doctor
