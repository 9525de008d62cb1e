// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

namespace flagstone::eval {

/// Mean and scatter of a figure over the scans for which it is defined.
struct Spread {
  std::size_t count = 0;                                   ///< scans
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< NaN of none
  std::optional<double> std;  ///< sample standard deviation (n - 1); none for fewer than two
  /// Half width of the 95 % confidence interval of the mean, t * std / sqrt(n), by Student's t
  /// distribution with n - 1 degrees of freedom; none for fewer than two. It takes scans for
  /// independent; those of one drive are not, so that the truth is wider.
  std::optional<double> ci95;
};

/// Of the values that are not NaN.
Spread spread_of(std::span<const double> values);

/// Quantile 0.975 of Student's t distribution, `degrees` of freedom at least 1.
double student_t_975(std::size_t degrees);

/// The slowest 1 % of times: their mean, of at least one time. Needs one time or more.
double mean_of_slowest_percent(std::span<const double> times);

}  // namespace flagstone::eval
