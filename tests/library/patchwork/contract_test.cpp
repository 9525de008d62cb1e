// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Clauses of the data contract for Patchwork alone; for every method: tests/lab/baselines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

<<<<<<< HEAD
#include "outcome.hpp"
=======
#include "child_process.hpp"
#include "flagstone/flagstone.hpp"
>>>>>>> 4d93abf (A method's stages are files: CZM, plane fits, patch judge, grids; patchwork does not depend on the frame's height)
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

TEST(PatchworkContract, AllPointsEqualAreOnePlace) {
  const std::vector<Point> on_ground(5000, Point{6, 2, -1.7f});
  const std::vector<Point> in_the_air(5000, Point{6, 2, 1.5f});

  EXPECT_THAT(labels_of(on_ground), testing::Each(Label::ground));
  // Perfectly flat, so that the flatness term may believe it or not; but all of it or nothing.
  const std::vector<Label> air = labels_of(in_the_air);
  EXPECT_THAT(air, testing::Each(air.front()));
}

<<<<<<< HEAD
=======
TEST(Contract, TenMillionPointsAreSegmented) {
  const std::vector<Point> cloud = random_cloud(10'000'000, 13);
  Patchwork patchwork;
  Segmentation result;

  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  EXPECT_EQ(result.labels().size(), cloud.size());
  EXPECT_GT(result.count(Label::ground), cloud.size() / 2);
}

TEST(Contract, ThreadsOutsideOf1To1024AreRefusedWithTheirNumber) {
  for (const unsigned threads : {0U, 1025U, 4294967295U}) {
    try {
      const Patchwork patchwork({}, threads);
      ADD_FAILURE() << threads << " threads were accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("threads is " + std::to_string(threads)));
      EXPECT_THAT(error.what(), testing::HasSubstr("1 to 1024"));
    }
  }
}

TEST(Contract, ManyMoreThreadsThanCoresSegment) {
  const std::vector<Point> cloud = random_cloud(20000, 16);
  Patchwork patchwork({}, 64);
  Segmentation result;

  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), labels_of(cloud)));
}

TEST(Contract, AChildProcessSegmentsWithThreadsOfItsOwn) {
  const std::vector<Point> cloud = random_cloud(40000, 16);
  Patchwork patchwork({}, 2);
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());
  const std::vector<Label> labels(result.labels().begin(), result.labels().end());

  EXPECT_EQ(tests::exit_code_of_child([&] {
              return patchwork.segment(view_of(cloud), result).ok() &&
                             std::ranges::equal(result.labels(), labels)
                         ? 0
                         : 1;
            }),
            0);
}

TEST(Contract, AMovedSegmenterStillSegments) {
  const std::vector<Point> cloud = random_cloud(3000, 15);
  Patchwork original;
  Patchwork moved = std::move(original);
  Segmentation result;

  ASSERT_TRUE(moved.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), labels_of(cloud)));
}

>>>>>>> 4d93abf (A method's stages are files: CZM, plane fits, patch judge, grids; patchwork does not depend on the frame's height)
}  // namespace
}  // namespace flagstone
