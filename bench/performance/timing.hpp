// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "library/core/statistics.hpp"
#include "library/core/stopwatch.hpp"

namespace flagstone::performance {

/// The percentile of 100 * `share` (0 to 1); the values keep their order.
inline double quantile(std::vector<double> values, double share) {
  return percentile(values, 100 * share);
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
