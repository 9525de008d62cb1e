// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "library/core/statistics.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::performance {

/// The `fraction` quantile of the values, from 0 (minimum) to 1 (maximum).
inline double quantile(std::vector<double> values, double fraction) {
  return percentile(values, 100 * fraction);
}

/// Duration of an operation, milliseconds.
struct Duration {
  double median = 0;
  double minimum = 0;
};

/// Calls `work` twice as a warm-up, then repeatedly for `budget` milliseconds, at least 5 times.
template <class Work>
Duration time_of(const Work& work, double budget = 250) {
  work();
  work();
  std::vector<double> times;
  for (double elapsed = 0; times.size() < 5 || elapsed < budget; elapsed += times.back()) {
    Stopwatch stopwatch;
    work();
    times.push_back(stopwatch.lap());
  }
  return {.median = quantile(times, 0.5), .minimum = quantile(times, 0)};
}

}  // namespace flagstone::performance
