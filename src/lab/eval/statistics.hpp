// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace flagstone::eval {

/// Mean and standard deviation of a metric over the scans for which it is defined.
struct Spread {
  std::size_t count = 0;                                   ///< number of scans
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< NaN without values
  std::optional<double> std;  ///< sample standard deviation (n - 1); unset for fewer than two scans
  /// Half-width of the 95 % confidence interval of the mean, t * std / sqrt(n), with Student's t
  /// distribution and n - 1 degrees of freedom; unset for fewer than two scans. Assumes that scans
  /// are independent. Scans of one sequence are not, so the true interval is wider.
  std::optional<double> ci95;
};

/// Statistics of the values that are not NaN.
Spread spread_of(std::span<const double> values);

/// Quantile 0.975 of Student's t distribution. `degrees` of freedom must be at least 1.
double student_t_975(std::size_t degrees);

/// Mean of the slowest 1 % of the times, but of at least one time. `times` must not be empty.
double mean_of_slowest_percent(std::span<const double> times);

}  // namespace flagstone::eval
