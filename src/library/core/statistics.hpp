// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <ranges>
#include <span>

namespace flagstone {

/// A vector, an array or a span of floats or doubles that can be reordered.
template <class Values>
concept SortableNumbers =
    std::ranges::random_access_range<Values> && std::ranges::sized_range<Values> &&
    std::floating_point<std::ranges::range_value_t<Values>> &&
    std::permutable<std::ranges::iterator_t<Values>>;

/// The nearest-rank percentile: the smallest value that is not exceeded by at least `percent` (0 to
/// 100) per cent of `values`. Takes linear time, reorders `values` and does not allocate. NaN if
/// there are no values.
template <SortableNumbers Values>
std::ranges::range_value_t<Values> percentile(Values&& values, double percent) {
  using Value = std::ranges::range_value_t<Values>;
  const std::size_t size = std::ranges::size(values);
  if (size == 0) return std::numeric_limits<Value>::quiet_NaN();
  const auto rank = static_cast<std::size_t>(std::ceil(static_cast<double>(size) * percent / 100));
  const auto nth = std::ranges::begin(values) +
                   static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, size) - 1);
  std::ranges::nth_element(values, nth);
  return *nth;
}

/// The median: the middle value, or the mean of the two middle values. Takes linear time, reorders
/// `values` and does not allocate. NaN if there are no values.
template <SortableNumbers Values>
std::ranges::range_value_t<Values> median(Values&& values) {
  const auto lower = percentile(values, 50);
  const std::size_t size = std::ranges::size(values);
  if (size == 0 || size % 2 == 1) return lower;
  const auto upper_half = std::ranges::begin(values) + static_cast<std::ptrdiff_t>(size / 2);
  return (lower + *std::ranges::min_element(upper_half, std::ranges::end(values))) / 2;
}

/// The mean. NaN if there are no values.
inline double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Standard deviation of a sample, with divisor n - 1. NaN if there are fewer than two values.
inline double standard_deviation(std::span<const double> values) {
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
}

}  // namespace flagstone
