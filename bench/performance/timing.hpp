// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "library/core/stopwatch.hpp"

namespace flagstone::performance {

/// Value below which `share` (0 to 1) of the values lie; the greatest for 1. Needs at least one.
inline double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
  return values[std::min(rank, values.size() - 1)];
}

/// How long something takes, milliseconds.
struct Duration {
  double median = 0;
  double least = 0;
};

/// Does `work` twice to warm up and then again and again: for `budget` milliseconds, 5 times at
/// least.
template <class Work>
Duration time_of(const Work& work, double budget = 250) {
  work();
  work();
  std::vector<double> times;
  for (double spent = 0; times.size() < 5 || spent < budget; spent += times.back()) {
    Stopwatch stopwatch;
    work();
    times.push_back(stopwatch.lap());
  }
  return {.median = quantile(times, 0.5), .least = quantile(times, 0)};
}

}  // namespace flagstone::performance
