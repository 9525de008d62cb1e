// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The data contract of all methods, one test per clause.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "methods.hpp"
#include "numbers.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::view_of;

std::vector<Label> labels_of(const tests::Method& method, CloudView cloud) {
  Segmentation result;
  EXPECT_TRUE(method.make()->segment(cloud, result).ok());
  return {result.labels().begin(), result.labels().end()};
}

std::size_t sum_of_counts(const Segmentation& result) {
  std::size_t sum = 0;
  for (std::size_t code = 0; code < label_count; ++code) {
    sum += result.count(static_cast<Label>(code));
  }
  return sum;
}

/// Tests of the data contract; the parameter is the method.
class Contract : public testing::TestWithParam<tests::Method> {
 protected:
  [[nodiscard]] static std::vector<Label> labels_of(CloudView cloud) {
    return flagstone::labels_of(GetParam(), cloud);
  }
  [[nodiscard]] static std::vector<Label> labels_of(const std::vector<Point>& cloud) {
    return labels_of(view_of(cloud));
  }

  std::unique_ptr<Segmenter> segmenter = GetParam().make();
  Segmentation result;
};

INSTANTIATE_TEST_SUITE_P(All, Contract, testing::ValuesIn(tests::methods()), tests::name_of);

TEST_P(Contract, OneLabelPerPointAndCountsAddUp) {
  for (const std::size_t points : {0u, 1u, 2u, 3u, 100u, 12345u}) {
    ASSERT_TRUE(segmenter->segment(view_of(corrupted_cloud(points, 3)), result).ok());

    EXPECT_EQ(result.labels().size(), points);
    EXPECT_EQ(sum_of_counts(result), points);
  }
}

TEST_P(Contract, FindsGround) {
  ASSERT_TRUE(segmenter->segment(view_of(random_cloud(64000, 2)), result).ok());

  EXPECT_GT(result.count(Label::ground), 64000u / 3);
  EXPECT_GT(result.count(Label::nonground), 0u);
}

TEST_P(Contract, LabelsAreInInputOrder) {
  std::vector<Point> cloud = random_cloud(6400, 1);
  cloud[3000].y = nan;
  cloud.back() = {1e6f, 0, 0};

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[3000], Label::invalid);
  EXPECT_EQ(labels.back(), Label::out_of_range);
  EXPECT_EQ(std::ranges::count(labels, Label::invalid), 1);
}

TEST_P(Contract, KeepsNoStateBetweenScans) {
  // Large, corrupted, and with too few points for a patch or a cell.
  const std::vector<std::vector<Point>> clouds = {random_cloud(20000, 1),
                                                  corrupted_cloud(9000, 2),
                                                  {},
                                                  {{6, 2, -1.5f}},
                                                  random_cloud(64, 3),
                                                  std::vector<Point>(40, Point{6, 2, -1.2f}),
                                                  std::vector<Point>(100, Point{nan, 0, 0}),
                                                  std::vector<Point>(500, Point{10, 0, -900})};
  for (const std::vector<Point>& second : clouds) {
    const tests::Outcome fresh = tests::segmented(*GetParam().make(), view_of(second));
    for (const std::vector<Point>& first : clouds) {
      tests::segmented(*segmenter, view_of(first));

      EXPECT_TRUE(tests::is_same(fresh, tests::segmented(*segmenter, view_of(second))))
          << second.size() << " points after " << first.size();
    }
  }
}

TEST_P(Contract, RepeatedRunsAreBitIdentical) {
  const std::vector<Point> cloud = corrupted_cloud(30000, 7);
  const tests::Outcome outcome = tests::segmented(*segmenter, view_of(cloud));

  for (int repeat = 0; repeat < 5; ++repeat) {
    EXPECT_TRUE(tests::is_same(outcome, tests::segmented(*segmenter, view_of(cloud))));
  }
}

TEST_P(Contract, TheLayoutOfTheInputDoesNotMatter) {
  const std::vector<Point> cloud = corrupted_cloud(5000, 8);
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

TEST_P(Contract, ANegativeStrideKeepsTheOrderOfTheView) {
  const std::vector<Point> cloud = corrupted_cloud(5000, 8);
  std::vector<Point> reversed(cloud.rbegin(), cloud.rend());
  constexpr std::ptrdiff_t step = sizeof(Point);

  const CloudView backwards(&reversed.back(), reversed.size(), {-step, 0, 4, 8});

  EXPECT_EQ(labels_of(backwards), labels_of(cloud));
}

TEST_P(Contract, ReadsNothingOutsideTheInputBuffer) {
  // The buffer has the exact size of its points, so AddressSanitizer detects reads past its end.
  for (std::size_t points = 1; points < 70; ++points) {
    EXPECT_EQ(labels_of(random_cloud(points, 9)).size(), points);
  }
}

TEST_P(Contract, PrintsNothing) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::vector<Label> labels = labels_of(corrupted_cloud(20000, 10));

  EXPECT_EQ(labels.size(), 20000u);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(Contract, AcceptsAnyFloatValue) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint32_t>& bits) {
    std::vector<float> floats(bits.size());
    std::ranges::transform(bits, floats.begin(),
                           [](std::uint32_t pattern) { return std::bit_cast<float>(pattern); });
    const std::size_t points = floats.size() / 3;

    RC_ASSERT(labels_of(CloudView(floats.data(), points)).size() == points);
  }));
}

TEST_P(Contract, NonFiniteCoordinatesAreInvalid) {
  for (const float bad : {nan, inf, -inf}) {
    EXPECT_EQ(labels_of({{bad, 5, -1.7f}}), std::vector{Label::invalid});
    EXPECT_EQ(labels_of({{5, bad, -1.7f}}), std::vector{Label::invalid});
    EXPECT_EQ(labels_of({{5, 5, bad}}), std::vector{Label::invalid});
  }
}

TEST_P(Contract, AllZeroReturnsAreInvalid) {
  EXPECT_EQ(labels_of({{0, 0, 0}}), std::vector{Label::invalid});
  EXPECT_EQ(labels_of({{-0.0f, 0, -0.0f}}), std::vector{Label::invalid});
}

TEST_P(Contract, PointsMoreThanTenKilometresAwayAreOutOfRange) {
  for (const float far : {10001.0f, -10001.0f, 3e38f, -3e38f}) {
    EXPECT_EQ(labels_of({{far, 5, -1.7f}}), std::vector{Label::out_of_range});
    EXPECT_EQ(labels_of({{5, far, -1.7f}}), std::vector{Label::out_of_range});
    EXPECT_EQ(labels_of({{5, 5, far}}), std::vector{Label::out_of_range});
  }
}

TEST_P(Contract, HugeCoordinatesDoNotAffectOtherPoints) {
  const std::vector<Point> good = random_cloud(20000, 12);
  std::vector<Point> cloud = good;
  for (std::size_t i = 0; i < 500; ++i) {
    cloud.push_back({10 + 0.001f * static_cast<float>(i), 2, 3e38f});
    cloud.push_back({3e38f, 3e38f, 3e38f});
  }

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_TRUE(std::ranges::equal(std::span(labels).first(20000), labels_of(good)));
  EXPECT_THAT(std::vector(labels.begin() + 20000, labels.end()),
              testing::Each(Label::out_of_range));
}

TEST_P(Contract, AnEmptyCloudHasNoLabelsAndNoPatches) {
  EXPECT_TRUE(segmenter->segment(CloudView(), result).ok());

  EXPECT_TRUE(result.labels().empty());
  EXPECT_TRUE(result.patches().empty());
}

TEST_P(Contract, RejectsANullCloudWithPoints) {
  const Status status =
      segmenter->segment(CloudView(static_cast<const float*>(nullptr), 5), result);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_TRUE(result.labels().empty());
}

TEST_P(Contract, RejectsACloudWithMoreThan2To32MinusOnePoints) {
  const std::vector<float> memory(3);

  const Status status = segmenter->segment(CloudView(memory.data(), std::size_t{1} << 32U), result);

  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_TRUE(result.labels().empty());
}

TEST_P(Contract, ASinglePointHasALabel) {
  EXPECT_THAT(labels_of(std::vector<Point>{{8, 1, -1.7f}}), testing::SizeIs(1));
}

TEST_P(Contract, DenormalCoordinatesDoNotAffectOtherPoints) {
  const std::vector<Point> cloud = random_cloud(64000, 2);
  std::vector<Point> spoilt = cloud;
  constexpr float denormal = std::numeric_limits<float>::denorm_min();
  for (int i = 1; i <= 30; ++i) {
    spoilt.push_back({denormal, -denormal, static_cast<float>(i) * denormal});
  }

  const std::vector<Label> labels = labels_of(spoilt);

  EXPECT_EQ(labels.size(), spoilt.size());
  EXPECT_GT(std::ranges::count(labels, Label::ground), 0);
}

TEST_P(Contract, IdenticalPointsHaveTheSameLabel) {
  const std::vector<Label> labels = labels_of(std::vector<Point>(5000, Point{6, 2, -1.7f}));

  EXPECT_THAT(labels, testing::Each(labels.front()));
}

TEST_P(Contract, ACloudOfNonFinitePointsIsInvalid) {
  EXPECT_THAT(labels_of(std::vector<Point>(1000, {nan, nan, nan})), testing::Each(Label::invalid));
}

TEST_P(Contract, PatchesContainAllClassifiedPoints) {
  if (!GetParam().labels_follow_patches) GTEST_SKIP() << "points are labelled by their heights";
  ASSERT_TRUE(segmenter->segment(view_of(corrupted_cloud(50000, 14)), result).ok());
  if (result.patches().empty()) return;  // a method without patches

  std::size_t points = 0;
  std::size_t ground = 0;
  for (const Patch& patch : result.patches()) {
    EXPECT_GT(patch.point_count, 0u);
    points += patch.point_count;
    ground += patch.ground_count;
  }

  const std::size_t classified = result.count(Label::ground) + result.count(Label::nonground);
  EXPECT_GE(points, classified);
  EXPECT_LE(points, classified + result.count(Label::noise));
  EXPECT_EQ(ground, result.count(Label::ground));
}

TEST_P(Contract, EveryGroundPatchHasAPlane) {
  ASSERT_TRUE(segmenter->segment(view_of(corrupted_cloud(50000, 15)), result).ok());

  for (const Patch& patch : result.patches()) {
    if (!patch.is_ground()) continue;
    const auto& [x, y, z] = patch.normal;
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-5f);
    EXPECT_GE(z, 0);
    EXPECT_NEAR(x * patch.mean[0] + y * patch.mean[1] + z * patch.mean[2] + patch.d, 0, 1e-3f);
    EXPECT_GE(patch.eigenvalues[0], patch.eigenvalues[1]);
    EXPECT_GE(patch.eigenvalues[1], patch.eigenvalues[2]);
  }
}

/// Tests of methods that do not depend on the order of points; the parameter is the method.
class OrderFreeMethod : public testing::TestWithParam<tests::Method> {};

INSTANTIATE_TEST_SUITE_P(All, OrderFreeMethod, testing::ValuesIn(tests::order_free_methods()),
                         tests::name_of);

TEST_P(OrderFreeMethod, PermutingTheInputPermutesTheLabels) {
  EXPECT_TRUE(rc::check([](std::uint32_t seed) {
    const std::vector<Point> cloud = corrupted_cloud(4000, seed % 1000);
    std::vector<std::size_t> order(cloud.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::shuffle(order, std::mt19937(seed));
    std::vector<Point> shuffled;
    shuffled.reserve(order.size());
    for (const std::size_t i : order) shuffled.push_back(cloud[i]);

    const std::vector<Label> labels = labels_of(GetParam(), view_of(cloud));
    const std::vector<Label> of_shuffled = labels_of(GetParam(), view_of(shuffled));

    std::size_t different = 0;
    for (std::size_t i = 0; i < order.size(); ++i) different += of_shuffled[i] != labels[order[i]];
    RC_ASSERT(different <= GetParam().order_tolerance.value());
  }));
}

}  // namespace
}  // namespace flagstone
