// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/height_score.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace flagstone::eval {
namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr double tiny = 1e-6;

// A point at a horizontal range, 1 m above the true ground, and what a method says of it.
struct Judged {
  float range;
  float height;  // the method's; the true one is 1
  Truth truth = Truth::ground;
  float true_ground = -2;
};

HeightScore score(const std::vector<Judged>& points) {
  std::vector<float> cloud;
  std::vector<Truth> truth;
  std::vector<float> true_ground;
  std::vector<float> heights;
  for (const Judged& point : points) {
    cloud.insert(cloud.end(), {0.6F * point.range, -0.8F * point.range, -1});
    truth.push_back(point.truth);
    true_ground.push_back(point.true_ground);
    heights.push_back(point.height);
  }
  return score_heights(CloudView(cloud.data(), points.size(), 3), truth, true_ground, heights);
}

TEST(HeightScore, IsMedian95thPercentileAndMeanOfTheErrors) {
  // Errors -0.5, 0.25, 0, 1.
  const HeightErrors errors = score({{5, 0.5F}, {5, 1.25F}, {5, 1}, {5, 2}}).ground.all;

  EXPECT_EQ(errors.points, 4U);
  EXPECT_EQ(errors.given, 4U);
  EXPECT_NEAR(errors.median, 0.25, tiny);
  EXPECT_NEAR(errors.percentile95, 1, tiny);
  EXPECT_NEAR(errors.bias, 0.1875, tiny);
}

TEST(HeightScore, PercentilesAreErrorsThatThatManyPointsDoNotExceed) {
  std::vector<Judged> points;
  for (int i = 1; i <= 100; ++i) points.push_back({5, 1 + 0.01F * static_cast<float>(i)});

  const HeightErrors errors = score(points).ground.all;

  EXPECT_NEAR(errors.median, 0.5, tiny);
  EXPECT_NEAR(errors.percentile95, 0.95, tiny);
}

TEST(HeightScore, BiasIsAboveZeroWhereTheMethodPutsTheGroundTooLow) {
  EXPECT_NEAR(score({{5, 1.1F}}).ground.all.bias, 0.1, tiny);
  EXPECT_NEAR(score({{5, 0.9F}}).ground.all.bias, -0.1, tiny);
}

TEST(HeightScore, PointsWithoutAHeightCountInTheShareOnly) {
  const HeightErrors errors = score({{5, 1.5F}, {5, unknown}, {5, unknown}, {5, 1.5F}}).ground.all;

  EXPECT_EQ(errors.points, 4U);
  EXPECT_EQ(errors.given, 2U);
  EXPECT_EQ(errors.share(), 0.5);
  EXPECT_NEAR(errors.median, 0.5, tiny);
}

TEST(HeightScore, PointsWithoutATruthCountNowhere) {
  const HeightScore scored =
      score({{5, 1.5F}, {5, 9, Truth::ground, unknown}, {5, 9, Truth::ground, unknown}});

  EXPECT_EQ(scored.everywhere.all.points, 1U);
  EXPECT_EQ(scored.ground.all.points, 1U);
}

TEST(HeightScore, OfNoPointsHasNoShare) {
  const HeightErrors none = score({}).ground.all;

  EXPECT_EQ(none.points, 0U);
  EXPECT_EQ(none.share(), std::nullopt);
}

TEST(HeightScore, TellsGroundFromWhatStandsOnIt) {
  const HeightScore scored =
      score({{5, 1.25F}, {5, 1.5F, Truth::not_ground}, {5, 1.5F, Truth::ignored}});

  EXPECT_EQ(scored.ground.all.points, 1U);
  EXPECT_NEAR(scored.ground.all.median, 0.25, tiny);
  EXPECT_EQ(scored.everywhere.all.points, 3U);
  EXPECT_NEAR(scored.everywhere.all.median, 0.5, tiny);
}

TEST(HeightScore, BandsOfRangeReachTo20To40AndTo80Metres) {
  const HeightErrorsByRange ground =
      score({{1, 1.5F}, {19.9F, 1.5F}, {20.1F, 2}, {39.9F, 2}, {40.1F, 3}, {79.9F, 3}, {90, 5}})
          .ground;

  EXPECT_EQ(ground.all.points, 7U);
  EXPECT_EQ(ground.by_range[0].points, 2U);
  EXPECT_NEAR(ground.by_range[0].median, 0.5, tiny);
  EXPECT_EQ(ground.by_range[1].points, 2U);
  EXPECT_NEAR(ground.by_range[1].median, 1, tiny);
  EXPECT_EQ(ground.by_range[2].points, 2U);
  EXPECT_NEAR(ground.by_range[2].median, 2, tiny);
}

}  // namespace
}  // namespace flagstone::eval
