// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/score.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <limits>
#include <vector>

namespace flagstone::eval {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
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

TEST(Score, ATinyScanComputedByHand) {
  // One cell holds two points, right and wrong; another holds one that is right.
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

TEST(Score, ABandBeginsAtTheEndOfTheOneBefore) {
  const Score score =
      score_of({{10, 0, 0}, {0, -9.99f, 0}, {20, 0, 0}, {0, 40, 0}, {80, 0, 0}},
               {road, road, road, road, road}, {ground, ground, ground, ground, ground});

  EXPECT_EQ(score.by_range[0].total(), 1);
  EXPECT_EQ(score.by_range[1].total(), 1);
  EXPECT_EQ(score.by_range[2].total(), 1);
  EXPECT_EQ(score.by_range[3].total(), 1);
  EXPECT_EQ(score.points.total(), 5);
}

TEST(Score, ManyPointsOfOneCellCountAsMuchAsOneOfAnother) {
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

TEST(Score, PointsThatAreNotScoredTakeNoShareOfTheirCell) {
  const Score score =
      score_of({{5.1f, 5.1f, 0}, {5.2f, 5.2f, 0}}, {road, unlabelled}, {ground, ground});

  EXPECT_DOUBLE_EQ(score.by_area.true_positives, 1);
  EXPECT_DOUBLE_EQ(score.by_area.total(), 1);
}

TEST(Score, APointWithoutAPlaceCountsAmongThePointsOnly) {
  const Score score = score_of({{nan, 0, 0}}, {road}, {invalid});

  EXPECT_EQ(score.points.false_negatives, 1);
  EXPECT_EQ(score.by_area.total(), 0);
  for (const Confusion& band : score.by_range) EXPECT_EQ(band.total(), 0);
}

RC_GTEST_PROP(Score, AgreesWithTheComparisonOfLabelsAndItsPartsAddUp, ()) {
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

}  // namespace
}  // namespace flagstone::eval
