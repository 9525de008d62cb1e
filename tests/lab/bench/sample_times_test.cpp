// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/bench/sample_times.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

namespace flagstone::bench {
namespace {

/// Times of one scan in successive rounds.
SampleTimes of_one_scan(const std::vector<double>& milliseconds) {
  SampleTimes times(1);
  for (std::size_t round = 0; round < milliseconds.size(); ++round) {
    times.add(round, 0, milliseconds[round]);
  }
  return times;
}

TEST(SampleTimes, MedianIsTheMiddleTimeOrTheMeanOfTheTwoMiddleTimes) {
  EXPECT_EQ(of_one_scan({5, 1, 3}).median(), 3);
  EXPECT_EQ(of_one_scan({5, 1, 3, 4}).median(), 3.5);
}

TEST(SampleTimes, Percentile99IsTheSmallestTimeThat99PercentDoNotExceed) {
  std::vector<double> times(200);
  std::iota(times.rbegin(), times.rend(), 1);  // 200, 199, ..., 1

  EXPECT_EQ(of_one_scan(times).percentile_99(), 198);
  times.resize(100);  // 200 down to 101
  EXPECT_EQ(of_one_scan(times).percentile_99(), 199);
  EXPECT_EQ(of_one_scan({7, 2}).percentile_99(), 7);
}

TEST(SampleTimes, RatioComparesOnlyTimesOfTheSameRoundAndScan) {
  SampleTimes ours(2);
  SampleTimes others(2);
  ours.add(0, 0, 1);
  ours.add(0, 1, 100);
  ours.add(1, 0, 10);
  ours.add(2, 1, 1000);  // the other has no time in this round
  others.add(0, 0, 2);
  others.add(0, 1, 200);
  others.add(1, 0, 20);
  others.add(3, 0, 1);  // and ours has none in this one

  EXPECT_EQ(ours.ratio_to(others), 0.5);
  EXPECT_EQ(others.ratio_to(ours), 2);
}

TEST(SampleTimes, RatioIsTheMedianOfRatiosNotTheRatioOfMedians) {
  EXPECT_EQ(of_one_scan({1, 10, 100}).ratio_to(of_one_scan({1, 5, 200})), 1);
}

TEST(SampleTimes, PointsPerSecondUseThePointsOfTheTimedScan) {
  SampleTimes times(2);
  times.add(0, 0, 2);
  times.add(0, 1, 4);
  const std::vector<std::size_t> points = {2000, 4000};

  EXPECT_EQ(times.points_per_second(points), 1e6);
}

TEST(SampleTimes, StatisticsAreNanWithoutTimes) {
  const SampleTimes nothing(3);

  EXPECT_EQ(nothing.count(), 0U);
  EXPECT_TRUE(std::isnan(nothing.median()));
  EXPECT_TRUE(std::isnan(nothing.percentile_99()));
  EXPECT_TRUE(std::isnan(nothing.ratio_to(of_one_scan({1}))));
}

TEST(SampleTimes, SkippedRoundsAreNotCounted) {
  SampleTimes times(2);
  times.add(5, 1, 3);

  EXPECT_EQ(times.count(), 1U);
  EXPECT_EQ(times.median(), 3);
}

}  // namespace
}  // namespace flagstone::bench
