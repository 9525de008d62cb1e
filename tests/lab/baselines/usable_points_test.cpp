// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/usable_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "numbers.hpp"
#include "random_cloud.hpp"

namespace flagstone::baselines {
namespace {

using testing::ElementsAre;

struct Gathered {
  explicit Gathered(const std::vector<Point>& cloud) : labels(cloud.size(), Label::nonground) {
    points.reserve(cloud.size());
    points.gather(tests::view_of(cloud), labels);
  }

  UsablePoints points;
  std::vector<Label> labels;
};

TEST(UsablePoints, AreTheFinitePointsInInputOrder) {
  const Gathered gathered({{1, 2, 3}, {nan, 2, 3}, {4, 5, 6}, {7, -inf, 9}, {0, 0, 1}});

  EXPECT_THAT(gathered.points.x(), ElementsAre(1, 4, 0));
  EXPECT_THAT(gathered.points.y(), ElementsAre(2, 5, 0));
  EXPECT_THAT(gathered.points.z(), ElementsAre(3, 6, 1));
  EXPECT_THAT(gathered.points.index(), ElementsAre(0, 2, 4));
}

TEST(UsablePoints, LabelOnlyTheOtherPoints) {
  const Gathered gathered({{1, 2, 3}, {nan, 2, 3}, {0, -0.0f, 0}, {10001, 0, 0}, {0, 0, -3e38f}});

  EXPECT_THAT(gathered.labels, ElementsAre(Label::nonground, Label::invalid, Label::invalid,
                                           Label::out_of_range, Label::out_of_range));
}

TEST(UsablePoints, IncludePointsUpToTenKilometres) {
  const Gathered gathered({{max_coordinate, -max_coordinate, max_coordinate}});

  EXPECT_EQ(gathered.points.size(), 1u);
}

TEST(UsablePoints, BelowAHeightCanBeLabelledAndRemoved) {
  Gathered gathered({{1, 2, -3}, {nan, 2, -9}, {4, 5, -1}, {7, 8, -2}, {9, 9, -2.1f}});

  gathered.points.remove_below(-2, Label::noise, gathered.labels);

  EXPECT_THAT(gathered.points.z(), ElementsAre(-1, -2));
  EXPECT_THAT(gathered.points.index(), ElementsAre(2, 3));
  EXPECT_THAT(gathered.labels, ElementsAre(Label::noise, Label::invalid, Label::nonground,
                                           Label::nonground, Label::noise));
}

TEST(UsablePoints, OfASmallerScanReplaceAllPointsOfALargerOne) {
  Gathered gathered({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}});
  const std::vector<Point> smaller = {{4, 5, 6}};

  gathered.points.reserve(1);
  gathered.points.gather(tests::view_of(smaller), gathered.labels);

  EXPECT_THAT(gathered.points.x(), ElementsAre(4));
  EXPECT_THAT(gathered.points.y(), ElementsAre(5));
  EXPECT_THAT(gathered.points.z(), ElementsAre(6));
}

}  // namespace
}  // namespace flagstone::baselines
