// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/statistics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace flagstone::eval {
namespace {

TEST(ScanStatistics, MatchesASmallCaseComputedByHand) {
  constexpr std::array values = {2.0, 4.0, 9.0};

  const Spread spread = spread_of(values);

  EXPECT_DOUBLE_EQ(spread.mean, 5);
  EXPECT_DOUBLE_EQ(spread.std.value(), std::sqrt(13.0));  // (9 + 1 + 16) / 2
  EXPECT_NEAR(spread.ci95.value(), 4.303 * std::sqrt(13.0 / 3), 1e-9);
}

TEST(ScanStatistics, OneValueHasNoStandardDeviationAndNoInterval) {
  constexpr std::array values = {0.5};

  const Spread spread = spread_of(values);

  EXPECT_EQ(spread.mean, 0.5);
  EXPECT_FALSE(spread.std);
  EXPECT_FALSE(spread.ci95);
}

TEST(StudentT, AgreesWithPublishedTables) {
  EXPECT_NEAR(student_t_975(1), 12.706, 1e-3);
  EXPECT_NEAR(student_t_975(30), 2.042, 1e-3);
  EXPECT_NEAR(student_t_975(40), 2.021, 1e-3);
  EXPECT_NEAR(student_t_975(60), 2.000, 1e-3);
  EXPECT_NEAR(student_t_975(120), 1.980, 1e-3);
  EXPECT_NEAR(student_t_975(1000000), 1.960, 1e-3);
}

TEST(Slowest, OnePercentIsAtLeastOneTime) {
  constexpr std::array few = {1.0, 5.0, 2.0};
  std::vector<double> many(300, 1.0);
  many[7] = 10;
  many[8] = 20;
  many[9] = 30;

  EXPECT_EQ(mean_of_slowest_percent(few), 5);
  EXPECT_EQ(mean_of_slowest_percent(many), 20);
}

}  // namespace
}  // namespace flagstone::eval
