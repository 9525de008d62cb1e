// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/score.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "numbers.hpp"

namespace flagstone::eval {
namespace {

TEST(Confusion, MatchesASmallCaseComputedByHand) {
  using enum Truth;
  constexpr std::array labels = {Label::ground, Label::ground,    Label::ground, Label::nonground,
                                 Label::noise,  Label::nonground, Label::ground};
  constexpr std::array truth = {ground, ground, not_ground, ground, ground, not_ground, ignored};

  const Confusion confusion = compare(labels, truth);

  EXPECT_EQ(confusion.true_positives, 2u);
  EXPECT_EQ(confusion.false_positives, 1u);
  EXPECT_EQ(confusion.false_negatives, 2u);
  EXPECT_EQ(confusion.true_negatives, 1u);
  EXPECT_DOUBLE_EQ(confusion.precision(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(confusion.recall(), 0.5);
  EXPECT_DOUBLE_EQ(confusion.f1(), 4.0 / 7);
  EXPECT_DOUBLE_EQ(confusion.accuracy(), 0.5);
}

TEST(Confusion, AllOtherLabelsCountAsNotGround) {
  constexpr std::array labels = {Label::noise, Label::out_of_range, Label::invalid};
  constexpr std::array truth = {Truth::ground, Truth::not_ground, Truth::ground};

  const Confusion confusion = compare(labels, truth);

  EXPECT_EQ(confusion.false_negatives, 2u);
  EXPECT_EQ(confusion.true_negatives, 1u);
}

TEST(Confusion, OnlyTheAccuracyIsDefinedWithoutGroundInTheGroundTruth) {
  using enum Truth;
  constexpr std::array labels = {Label::ground, Label::nonground, Label::nonground,
                                 Label::nonground};
  constexpr std::array truth = {not_ground, not_ground, not_ground, not_ground};

  const Confusion confusion = compare(labels, truth);

  EXPECT_TRUE(std::isnan(confusion.precision()));
  EXPECT_TRUE(std::isnan(confusion.recall()));
  EXPECT_TRUE(std::isnan(confusion.f1()));
  EXPECT_TRUE(std::isnan(confusion.iou()));
  EXPECT_EQ(confusion.accuracy(), 0.75);
  EXPECT_EQ(scores_text(confusion), "no ground in the ground truth, accuracy 75.00 %");
}

TEST(Confusion, ThePrecisionIsUndefinedWithoutPointsLabelledGround) {
  constexpr std::array labels = {Label::nonground};
  constexpr std::array truth = {Truth::ground};

  const Confusion confusion = compare(labels, truth);

  EXPECT_TRUE(std::isnan(confusion.precision()));
  EXPECT_EQ(confusion.recall(), 0);
  EXPECT_EQ(confusion.f1(), 0);
  EXPECT_EQ(scores_text(confusion), "precision n/a %, recall 0.00 %, F1 0.00 %");
}

constexpr std::uint32_t road = 40;
constexpr std::uint32_t building = 50;
constexpr std::uint32_t unlabelled = 0;
using enum Label;

Score score_of(const std::vector<Point>& points, const std::vector<std::uint32_t>& classes,
               const std::vector<Label>& labels) {
  ScanTruth truth;
  truth.set(patchwork_plusplus_protocol(), CloudView(std::span<const Point>(points)), classes);
  return truth.score(labels);
}

TEST(Score, MatchesASmallScanComputedByHand) {
  // One cell contains two points, one correct and one wrong. Another cell contains one correct
  // point.
  const Score score = score_of({{3.1f, 0.1f, 0}, {3.2f, 0.2f, 0}, {15.1f, 0.1f, 0}},
                               {road, building, road}, {ground, ground, ground});

  EXPECT_DOUBLE_EQ(score.points.precision(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(score.points.recall(), 1);
  EXPECT_DOUBLE_EQ(score.points.f1(), 0.8);
  EXPECT_DOUBLE_EQ(score.points.accuracy(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(score.points.iou(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(score.by_range[0].precision(), 0.5);
  EXPECT_DOUBLE_EQ(score.by_range[1].precision(), 1);
  EXPECT_DOUBLE_EQ(score.by_area.total(), 2);
  EXPECT_DOUBLE_EQ(score.by_area.precision(), 0.75);
}

TEST(Score, ABandBeginsAtTheEndOfThePreviousBand) {
  const Score score =
      score_of({{10, 0, 0}, {0, -9.99f, 0}, {20, 0, 0}, {0, 40, 0}, {80, 0, 0}},
               {road, road, road, road, road}, {ground, ground, ground, ground, ground});

  EXPECT_EQ(score.by_range[0].total(), 1);
  EXPECT_EQ(score.by_range[1].total(), 1);
  EXPECT_EQ(score.by_range[2].total(), 1);
  EXPECT_EQ(score.by_range[3].total(), 1);
  EXPECT_EQ(score.points.total(), 5);
}

TEST(Score, CellsHaveEqualWeightForAnyNumberOfPoints) {
  std::vector<Point> points(1000, Point{5.2f, 5.2f, 0});
  std::vector<std::uint32_t> classes(1000, road);
  std::vector<Label> labels(1000, ground);
  points.push_back({30.2f, 0.2f, 0});
  classes.push_back(road);
  labels.push_back(nonground);

  const Score score = score_of(points, classes, labels);

  EXPECT_NEAR(score.by_area.recall(), 0.5, 1e-6);
  EXPECT_GT(score.points.recall(), 0.99);
}

TEST(Score, UnscoredPointsHaveNoWeightInTheirCell) {
  const Score score =
      score_of({{5.1f, 5.1f, 0}, {5.2f, 5.2f, 0}}, {road, unlabelled}, {ground, ground});

  EXPECT_DOUBLE_EQ(score.by_area.true_positives, 1);
  EXPECT_DOUBLE_EQ(score.by_area.total(), 1);
}

TEST(Score, AnInvalidPointCountsOnlyAmongThePoints) {
  const Score score = score_of({{nan, 0, 0}}, {road}, {invalid});

  EXPECT_EQ(score.points.false_negatives, 1);
  EXPECT_EQ(score.by_area.total(), 0);
  for (const Confusion& band : score.by_range) EXPECT_EQ(band.total(), 0);
}

RC_GTEST_PROP(Score, AgreesWithCompareAndItsPartsAddUp, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(0, 200);
  const auto coordinate = rc::gen::map(rc::gen::inRange(-1000, 1000),
                                       [](int v) { return static_cast<float>(v) * 0.1f; });
  const auto codes = *rc::gen::container<std::vector<int>>(count, rc::gen::inRange(0, 5));
  const auto classes = *rc::gen::container<std::vector<std::uint32_t>>(
      count, rc::gen::element(road, building, unlabelled));
  std::vector<Point> points;
  std::vector<Label> labels;
  for (const int code : codes) {
    points.push_back({*coordinate, *coordinate, *coordinate});
    labels.push_back(static_cast<Label>(code));
  }
  ScanTruth truth;
  truth.set(patchwork_plusplus_protocol(), CloudView(std::span<const Point>(points)), classes);

  const Score score = truth.score(labels);

  const Confusion all = compare(labels, truth.truth());
  RC_ASSERT(score.points.true_positives == all.true_positives);
  RC_ASSERT(score.points.false_positives == all.false_positives);
  RC_ASSERT(score.points.false_negatives == all.false_negatives);
  RC_ASSERT(score.points.true_negatives == all.true_negatives);
  double in_bands = 0;
  for (const Confusion& band : score.by_range) in_bands += band.total();
  RC_ASSERT(in_bands <= all.total());
  RC_ASSERT(score.by_area.total() <= all.total() + 1e-6);
}

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr double tiny = 1e-6;

// A point at a horizontal range, 1 m above the true ground, and its estimated height.
struct HeightSample {
  float range;
  float height;  // estimated; the true height is 1
  Truth truth = Truth::ground;
  float true_ground = -2;
};

HeightScore score(const std::vector<HeightSample>& points) {
  std::vector<float> cloud;
  std::vector<Truth> truth;
  std::vector<float> true_ground;
  std::vector<float> heights;
  for (const HeightSample& point : points) {
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

TEST(HeightScore, PercentilesAreErrorsThatThisPercentageOfPointsDoesNotExceed) {
  std::vector<HeightSample> points;
  for (int i = 1; i <= 100; ++i) points.push_back({5, 1 + 0.01F * static_cast<float>(i)});

  const HeightErrors errors = score(points).ground.all;

  EXPECT_NEAR(errors.median, 0.5, tiny);
  EXPECT_NEAR(errors.percentile95, 0.95, tiny);
}

TEST(HeightScore, BiasIsPositiveIfTheEstimatedGroundIsTooLow) {
  EXPECT_NEAR(score({{5, 1.1F}}).ground.all.bias, 0.1, tiny);
  EXPECT_NEAR(score({{5, 0.9F}}).ground.all.bias, -0.1, tiny);
}

TEST(HeightScore, PointsWithoutAHeightCountOnlyInTheCoverage) {
  const HeightErrors errors = score({{5, 1.5F}, {5, unknown}, {5, unknown}, {5, 1.5F}}).ground.all;

  EXPECT_EQ(errors.points, 4U);
  EXPECT_EQ(errors.given, 2U);
  EXPECT_EQ(errors.share(), 0.5);
  EXPECT_NEAR(errors.median, 0.5, tiny);
}

TEST(HeightScore, PointsWithoutATrueHeightAreExcluded) {
  const HeightScore scored =
      score({{5, 1.5F}, {5, 9, Truth::ground, unknown}, {5, 9, Truth::ground, unknown}});

  EXPECT_EQ(scored.everywhere.all.points, 1U);
  EXPECT_EQ(scored.ground.all.points, 1U);
}

TEST(HeightScore, HasNoCoverageWithoutPoints) {
  const HeightErrors none = score({}).ground.all;

  EXPECT_EQ(none.points, 0U);
  EXPECT_EQ(none.share(), std::nullopt);
}

TEST(HeightScore, SeparatesGroundPointsFromAllPoints) {
  const HeightScore scored =
      score({{5, 1.25F}, {5, 1.5F, Truth::not_ground}, {5, 1.5F, Truth::ignored}});

  EXPECT_EQ(scored.ground.all.points, 1U);
  EXPECT_NEAR(scored.ground.all.median, 0.25, tiny);
  EXPECT_EQ(scored.everywhere.all.points, 3U);
  EXPECT_NEAR(scored.everywhere.all.median, 0.5, tiny);
}

TEST(HeightScore, CommonPointsHaveAHeightFromEveryMethod) {
  const std::vector<float> values = {5, 0, 1, 6, 0, 1, 7, 0, 1, 30, 0, 1};
  const CloudView cloud(values.data(), 4);
  const std::vector<Truth> truth = {Truth::ground, Truth::ground, Truth::not_ground, Truth::ground};
  const std::vector<float> true_ground(4, 1.0F);
  const float none = std::numeric_limits<float>::quiet_NaN();
  const std::vector<std::vector<float>> heights = {{0.1F, 0.2F, 0.3F, 0.4F},
                                                   {none, 0.5F, 0.6F, 0.7F}};
  std::vector<HeightScore> scores;
  for (const auto& own : heights) scores.push_back(score_heights(cloud, truth, true_ground, own));
  EXPECT_FALSE(scores[0].has_common);

  score_common_heights(cloud, truth, true_ground, heights, std::array{&scores[0], &scores[1]});

  EXPECT_EQ(scores[0].ground.all.points, 3U) << "unchanged";
  for (const HeightScore& score : scores) {
    EXPECT_TRUE(score.has_common);
    EXPECT_EQ(score.common_ground.all.points, 2U);
    EXPECT_EQ(score.common_ground.all.given, 2U);
    EXPECT_EQ(score.common_ground.by_range[0].points, 1U);
    EXPECT_EQ(score.common_everywhere.all.points, 3U);
  }
  EXPECT_FLOAT_EQ(static_cast<float>(scores[0].common_ground.by_range[0].median), 0.2F);
  EXPECT_FLOAT_EQ(static_cast<float>(scores[1].common_ground.by_range[0].median), 0.5F);
}

TEST(HeightScore, RangeBandsEndAt20And40And80Metres) {
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
