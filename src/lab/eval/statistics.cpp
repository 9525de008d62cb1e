// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

#include "library/core/statistics.hpp"

namespace flagstone::eval {

double student_t_975(std::size_t degrees) {
  // Abramowitz and Stegun, "Handbook of Mathematical Functions", table 26.10.
  constexpr std::array table = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees <= table.size()) return table[std::max<std::size_t>(degrees, 1) - 1];
  // Their asymptotic expansion 26.7.5 around the normal quantile.
  constexpr double z = 1.959964;
  constexpr double z3 = z * z * z;
  constexpr double z5 = z3 * z * z;
  const auto n = static_cast<double>(degrees);
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n);
}

Spread spread_of(std::span<const double> all) {
  std::vector<double> values;
  std::ranges::copy_if(all, std::back_inserter(values), [](double v) { return !std::isnan(v); });
  Spread spread;
  spread.count = values.size();
  if (values.empty()) return spread;
  const auto n = static_cast<double>(values.size());
  spread.mean = mean(values);
  if (values.size() < 2) return spread;
  spread.std = standard_deviation(values);
  spread.ci95 = student_t_975(values.size() - 1) * *spread.std / std::sqrt(n);
  return spread;
}

double mean_of_slowest_percent(std::span<const double> times) {
  std::vector<double> sorted(times.begin(), times.end());
  std::ranges::sort(sorted, std::greater());
  const std::size_t count = std::max<std::size_t>(sorted.size() / 100, 1);
  const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
  return mean({sorted.begin(), end});
}

}  // namespace flagstone::eval
