// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Guarantees of Patchwork only. The guarantees of all methods are tested in tests/lab/baselines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::random_cloud;
using tests::view_of;

std::vector<Label> labels_of(const std::vector<Point>& cloud) {
  return tests::segmented(PatchworkConfig{}, view_of(cloud)).labels;
}

TEST(PatchworkContract, PointsNearerThanTheFirstRingOrBeyondTheLastAreOutOfRange) {
  EXPECT_EQ(labels_of({{1, 1, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{81, 0, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{3e38f, -3e38f, 0}}), std::vector{Label::out_of_range});
}

TEST(PatchworkContract, PointsFarBelowAnyGroundAreNoise) {
  std::vector<Point> cloud = random_cloud(64000, 11);
  cloud.push_back({10, 0.5f, -12});
  cloud.push_back({10, 0.5f, -9999});

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[64000], Label::noise);
  EXPECT_EQ(labels[64001], Label::noise);
  EXPECT_GT(std::ranges::count(labels, Label::ground), 30000);
}

TEST(PatchworkContract, EqualPointsAreOnePatch) {
  const std::vector<Point> on_ground(5000, Point{6, 2, -1.7f});
  const std::vector<Point> in_the_air(5000, Point{6, 2, 1.5f});

  EXPECT_THAT(labels_of(on_ground), testing::Each(Label::ground));
  // The patch is perfectly flat. The flatness term may accept or reject it, but only as a whole.
  const std::vector<Label> air = labels_of(in_the_air);
  EXPECT_THAT(air, testing::Each(air.front()));
}

}  // namespace
}  // namespace flagstone
