// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The data contract, clause by clause.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "flagstone/flagstone.hpp"
#include "made_up_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::made_up_cloud;
using tests::view_of;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

std::vector<Label> labels_of(CloudView cloud, const PatchworkConfig& config = {}) {
  Patchwork patchwork(config);
  Segmentation result;
  EXPECT_TRUE(patchwork.segment(cloud, result).ok());
  return {result.labels().begin(), result.labels().end()};
}

std::vector<Label> labels_of(const std::vector<Point>& cloud) { return labels_of(view_of(cloud)); }

bool same_bytes(const Segmentation& a, const Segmentation& b) {
  return std::ranges::equal(a.labels(), b.labels()) && a.patches().size() == b.patches().size() &&
         std::memcmp(a.patches().data(), b.patches().data(), a.patches().size_bytes()) == 0;
}

TEST(Contract, OneLabelPerPointAndCountsAddUp) {
  Patchwork patchwork;
  Segmentation result;
  for (const std::size_t points : {0u, 1u, 2u, 100u, 12345u}) {
    ASSERT_TRUE(patchwork.segment(view_of(corrupted_cloud(points, 3)), result).ok());

    EXPECT_EQ(result.labels().size(), points);
    std::size_t sum = 0;
    for (std::size_t code = 0; code < label_count; ++code) {
      sum += result.count(static_cast<Label>(code));
    }
    EXPECT_EQ(sum, points);
  }
}

TEST(Contract, LabelsAreInInputOrder) {
  // Ground, a point that is not finite in its middle, and one out of range at its end.
  std::vector<Point> cloud = made_up_cloud(6400, 1);
  cloud[3000].y = nan;
  cloud.back() = {500, 0, 0};

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[3000], Label::invalid);
  EXPECT_EQ(labels.back(), Label::out_of_range);
  EXPECT_EQ(std::ranges::count(labels, Label::invalid), 1);
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

TEST(Contract, AScanLeavesNoTraceInTheNext) {
  const std::vector<Point> first = corrupted_cloud(30000, 5);
  const std::vector<Point> second = made_up_cloud(9000, 6);
  Segmentation fresh;
  ASSERT_TRUE(Patchwork().segment(view_of(second), fresh).ok());

  Patchwork patchwork;
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(view_of(first), result).ok());
  ASSERT_TRUE(patchwork.segment(view_of(second), result).ok());

  EXPECT_TRUE(same_bytes(result, fresh));
}

TEST(Contract, RepeatsAreByteIdentical) {
  const std::vector<Point> cloud = corrupted_cloud(30000, 7);
  Patchwork patchwork;
  Segmentation first;
  ASSERT_TRUE(patchwork.segment(view_of(cloud), first).ok());

  for (int repeat = 0; repeat < 5; ++repeat) {
    Segmentation again;
    ASSERT_TRUE(patchwork.segment(view_of(cloud), again).ok());
    EXPECT_TRUE(same_bytes(again, first));
  }
}

TEST(Contract, TheLayoutOfTheInputDoesNotMatter) {
  const std::vector<Point> cloud = made_up_cloud(5000, 8);
  std::vector<float> planar(3 * cloud.size());
  std::vector<std::byte> blob(17 * cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    planar[i] = cloud[i].x;
    planar[i + cloud.size()] = cloud[i].y;
    planar[i + 2 * cloud.size()] = cloud[i].z;
    std::memcpy(blob.data() + 17 * i + 5, &cloud[i], sizeof(Point));
  }
  const auto n = static_cast<std::ptrdiff_t>(cloud.size());

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels_of(CloudView(planar.data(), cloud.size(), {4, 0, 4 * n, 8 * n})), labels);
  EXPECT_EQ(labels_of(CloudView(blob.data(), cloud.size(), {17, 5, 9, 13})), labels);
}

TEST(Contract, NothingIsReadOutsideTheUsersBuffer) {
  // Exactly as long as its points: AddressSanitizer sees a read beyond.
  for (std::size_t points = 1; points < 70; ++points) {
    const std::vector<Point> cloud = made_up_cloud(points, 9);
    EXPECT_EQ(labels_of(cloud).size(), points);
  }
}

TEST(Contract, NothingIsPrinted) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  labels_of(corrupted_cloud(20000, 10));

  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Contract, SegmentNeverThrows) {
  static_assert(
      noexcept(std::declval<Segmenter&>().segment(CloudView(), std::declval<Segmentation&>())));
  static_assert(
      noexcept(std::declval<Patchwork&>().segment(CloudView(), std::declval<Segmentation&>())));
}

TEST(Contract, CoordinatesThatAreNotFiniteAreInvalid) {
  for (const float bad : {nan, inf, -inf}) {
    EXPECT_EQ(labels_of({{bad, 5, -1.7f}}), std::vector{Label::invalid});
    EXPECT_EQ(labels_of({{5, bad, -1.7f}}), std::vector{Label::invalid});
    EXPECT_EQ(labels_of({{5, 5, bad}}), std::vector{Label::invalid});
  }
}

TEST(Contract, TheAllZeroReturnIsInvalid) {
  EXPECT_EQ(labels_of({{0, 0, 0}}), std::vector{Label::invalid});
  EXPECT_EQ(labels_of({{-0.0f, 0, -0.0f}}), std::vector{Label::invalid});
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
  std::vector<Point> cloud = made_up_cloud(64000, 11);
  cloud.push_back({10, 0.5f, -12});
  cloud.push_back({10, 0.5f, -9999});

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[64000], Label::noise);
  EXPECT_EQ(labels[64001], Label::noise);
  EXPECT_GT(std::ranges::count(labels, Label::ground), 30000);
}

TEST(Contract, AnEmptyCloudHasNoLabelsAndNoPatches) {
  Patchwork patchwork;
  Segmentation result;

  EXPECT_TRUE(patchwork.segment(CloudView(), result).ok());

  EXPECT_TRUE(result.labels().empty());
  EXPECT_TRUE(result.patches().empty());
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

TEST(Contract, AllNotFiniteIsAllInvalid) {
  EXPECT_THAT(labels_of(std::vector<Point>(1000, {nan, nan, nan})), testing::Each(Label::invalid));
}

TEST(Contract, HugeCoordinatesHarmNothingElse) {
  const std::vector<Point> good = made_up_cloud(20000, 12);
  std::vector<Point> cloud = good;
  for (std::size_t i = 0; i < 500; ++i) {
    cloud.push_back({10 + 0.001f * static_cast<float>(i), 2, 3e38f});
    cloud.push_back({3e38f, 3e38f, 3e38f});
  }

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_TRUE(std::ranges::equal(std::span(labels).first(20000), labels_of(good)));
  for (std::size_t i = 20000; i < labels.size(); ++i) EXPECT_NE(labels[i], Label::ground);
}

TEST(Contract, ANullCloudThatClaimsPointsIsRefused) {
  Patchwork patchwork;
  Segmentation result;

  const Status status = patchwork.segment(CloudView(static_cast<const float*>(nullptr), 5), result);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_TRUE(result.labels().empty());
}

TEST(Contract, TenMillionPointsAreSegmented) {
  const std::vector<Point> cloud = made_up_cloud(10'000'000, 13);
  Patchwork patchwork;
  Segmentation result;

  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  EXPECT_EQ(result.labels().size(), cloud.size());
  EXPECT_GT(result.count(Label::ground), cloud.size() / 2);
}

TEST(Contract, PatchesHoldEveryPointThatIsJudged) {
  const std::vector<Point> cloud = corrupted_cloud(50000, 14);
  Patchwork patchwork;
  Segmentation result;
  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  std::size_t points = 0;
  std::size_t ground = 0;
  for (const Patch& patch : result.patches()) {
    EXPECT_GT(patch.point_count, 0u);
    points += patch.point_count;
    ground += patch.ground_count;
  }

  const std::size_t judged = result.count(Label::ground) + result.count(Label::nonground);
  EXPECT_GE(points, judged);
  EXPECT_LE(points, judged + result.count(Label::noise));
  EXPECT_EQ(ground, result.count(Label::ground));
}

TEST(Contract, AMovedSegmenterStillSegments) {
  const std::vector<Point> cloud = made_up_cloud(3000, 15);
  Patchwork original;
  Patchwork moved = std::move(original);
  Segmentation result;

  ASSERT_TRUE(moved.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), labels_of(cloud)));
}

}  // namespace
}  // namespace flagstone
