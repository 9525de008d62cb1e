// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// What the data contract says of Patchwork alone; what it says of every method:
// tests/lab/baselines.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "flagstone/flagstone.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::view_of;

std::vector<Label> labels_of(const std::vector<Point>& cloud) {
  Patchwork patchwork;
  Segmentation result;
  EXPECT_TRUE(patchwork.segment(view_of(cloud), result).ok());
  return {result.labels().begin(), result.labels().end()};
}

TEST(Contract, PermutingTheInputPermutesTheLabels) {
  EXPECT_TRUE(rc::check([](std::uint32_t seed) {
    const std::vector<Point> cloud = corrupted_cloud(4000, seed % 1000);
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::shuffle(order, std::mt19937(seed));
    std::vector<Point> shuffled;
    shuffled.reserve(order.size());
    for (const std::size_t i : order) shuffled.push_back(cloud[i]);

    const std::vector<Label> labels = labels_of(cloud);
    const std::vector<Label> of_shuffled = labels_of(shuffled);

    std::size_t different = 0;  // points within rounding of a threshold may differ
    for (std::size_t i = 0; i < order.size(); ++i) different += of_shuffled[i] != labels[order[i]];
    RC_ASSERT(different <= 1u);
  }));
}

TEST(Contract, PointsMoreThanTenKilometresAboveOrBelowTheSensorAreOutOfRange) {
  EXPECT_EQ(labels_of({{5, 5, 10001}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{5, 5, -10001}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{5, 5, -3e38f}}), std::vector{Label::out_of_range});
}

TEST(Contract, PointsNearerThanTheFirstRingOrBeyondTheLastAreOutOfRange) {
  EXPECT_EQ(labels_of({{1, 1, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{81, 0, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{3e38f, -3e38f, 0}}), std::vector{Label::out_of_range});
}

TEST(Contract, PointsFarBelowAnyGroundAreNoise) {
  std::vector<Point> cloud = random_cloud(64000, 11);
  cloud.push_back({10, 0.5f, -12});
  cloud.push_back({10, 0.5f, -9999});

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[64000], Label::noise);
  EXPECT_EQ(labels[64001], Label::noise);
  EXPECT_GT(std::ranges::count(labels, Label::ground), 30000);
}

TEST(Contract, OnePointIsLabelled) { EXPECT_EQ(labels_of({{5, 5, 3}}).size(), 1u); }

TEST(Contract, AllPointsEqualAreOnePlace) {
  const std::vector<Point> on_ground(5000, Point{6, 2, -1.7f});
  const std::vector<Point> in_the_air(5000, Point{6, 2, 1.5f});

  EXPECT_THAT(labels_of(on_ground), testing::Each(Label::ground));
  // Perfectly flat, so that the flatness term may believe it or not; but all of it or nothing.
  const std::vector<Label> air = labels_of(in_the_air);
  EXPECT_THAT(air, testing::Each(air.front()));
}

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

TEST(Contract, AMovedSegmenterStillSegments) {
  const std::vector<Point> cloud = random_cloud(3000, 15);
  Patchwork original;
  Patchwork moved = std::move(original);
  Segmentation result;

  ASSERT_TRUE(moved.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), labels_of(cloud)));
}

}  // namespace
}  // namespace flagstone
