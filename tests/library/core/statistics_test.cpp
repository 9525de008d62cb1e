// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/statistics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace flagstone {
namespace {

TEST(Statistics, PercentileIsTheSmallestValueNotExceededByThisFraction) {
  std::vector<double> values(200);
  std::iota(values.rbegin(), values.rend(), 1);  // 200, 199, ..., 1

  EXPECT_EQ(percentile(values, 99), 198);
  EXPECT_EQ(percentile(values, 99.1), 199);
  EXPECT_EQ(percentile(values, 50), 100);
  EXPECT_EQ(percentile(values, 0), 1);
  EXPECT_EQ(percentile(values, 100), 200);
  EXPECT_EQ(percentile(std::array{7.F, 2.F}, 99), 7.F);
  EXPECT_EQ(percentile(std::array{7.F, 2.F}, 50), 2.F);
}

TEST(Statistics, MedianIsTheMiddleValueOrTheMeanOfTheTwoMiddleValues) {
  EXPECT_EQ(median(std::array{5., 1., 3.}), 3);
  EXPECT_EQ(median(std::array{5., 1., 3., 4.}), 3.5);
  EXPECT_EQ(median(std::array{4.F}), 4.F);
}

TEST(Statistics, MeanAndStandardDeviationOfASample) {
  const std::array values{2., 4., 4., 4., 5., 5., 7., 9.};

  EXPECT_EQ(mean(values), 5);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(32. / 7));
}

TEST(Statistics, AreNanWithoutValues) {
  std::vector<double> nothing;

  EXPECT_TRUE(std::isnan(percentile(nothing, 50)));
  EXPECT_TRUE(std::isnan(median(nothing)));
  EXPECT_TRUE(std::isnan(mean(nothing)));
  EXPECT_TRUE(std::isnan(standard_deviation(std::array{1.})));
}

}  // namespace
}  // namespace flagstone
