// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Properties from Zermas et al. (2017), and known failures.
#include "flagstone/baselines/gpf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lab/baselines/gpf_segments.hpp"
#include "library/core/random.hpp"
#include "numbers.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

float uniform(Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

/// Ground at `height(x)` for x from -60 to 60 m, with noise of up to 3 cm.
template <class Height>
std::vector<Point> street(std::size_t points, const Height& height) {
  Random random(1);
  std::vector<Point> cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = uniform(random, -60, 60);
    cloud.push_back({x, uniform(random, -10, 10), height(x) + uniform(random, -0.03, 0.03)});
  }
  return cloud;
}

std::vector<Point> flat_street(std::size_t points) {
  return street(points, [](float) { return -1.73f; });
}

/// Ground that rises with increasing slope, by about 3 m in total.
std::vector<Point> rise() {
  return street(6000, [](float x) { return -1.73f + 0.0002f * (x + 60) * (x + 60); });
}

Segmentation segment(const std::vector<Point>& cloud, const GpfConfig& config = {}) {
  Segmentation result;
  EXPECT_TRUE(Gpf(config).segment(tests::view_of(cloud), result).ok());
  return result;
}

TEST(Gpf, SegmentsFollowAChangeOfSlopeThatOnePlaneDoesNot) {
  const std::vector<Point> valley =
      street(9000, [](float x) { return -1.73f + 0.1f * std::max(0.0f, std::abs(x) - 20); });

  const Segmentation three = segment(valley);
  const Segmentation one = segment(valley, {.segments = 1});

  EXPECT_EQ(three.count(Label::ground), valley.size());
  EXPECT_LT(one.count(Label::ground), valley.size() / 2);
  ASSERT_EQ(three.patches().size(), 3u);
  EXPECT_NEAR(three.patches()[0].normal[0] / three.patches()[0].normal[2], 0.1, 0.01);
  EXPECT_NEAR(three.patches()[1].normal[0], 0, 0.01);
  EXPECT_NEAR(three.patches()[2].normal[0] / three.patches()[2].normal[2], -0.1, 0.01);
}

TEST(Gpf, SegmentsAreNumberedFromTheRearAndContainAllPoints) {
  const std::vector<Point> cloud = flat_street(6000);

  const Segmentation result = segment(cloud);

  ASSERT_EQ(result.patches().size(), 3u);
  std::size_t points = 0;
  for (std::uint16_t s = 0; s < 3; ++s) {
    EXPECT_EQ(result.patches()[s].sector, s);
    points += result.patches()[s].point_count;
  }
  EXPECT_LT(result.patches()[0].mean[0], -20);
  EXPECT_GT(result.patches()[2].mean[0], 20);
  EXPECT_EQ(points, cloud.size());
}

TEST(Gpf, SegmentsAreCentredOnTheSensorWithOpenEnds) {
  const baselines::GpfSegments three(3, 40);
  const baselines::GpfSegments two(2, 10);

  EXPECT_EQ(three.segment_of(-10000), 0);
  EXPECT_EQ(three.segment_of(-20.01f), 0);
  EXPECT_EQ(three.segment_of(-20), 1);
  EXPECT_EQ(three.segment_of(19.99f), 1);
  EXPECT_EQ(three.segment_of(20), 2);
  EXPECT_EQ(three.segment_of(10000), 2);
  EXPECT_EQ(two.segment_of(-0.01f), 0);
  EXPECT_EQ(two.segment_of(0), 1);
}

TEST(Gpf, TheLowestPointRepresentativeToleratesOneReflectionBelowGround) {
  std::vector<Point> cloud = flat_street(6000);
  cloud.push_back({5, 1, -2.5f});

  // With 20 points the mean is 4 cm too low; with one point it is the reflection itself.
  EXPECT_EQ(segment(cloud).count(Label::ground), 6001u);
  EXPECT_EQ(segment(cloud, {.segments = 1, .lowest_points = 1}).count(Label::ground), 0u);
}

TEST(Gpf, ManyReflectionsBreakItUnlessTheyAreRemovedAsNoise) {
  std::vector<Point> cloud = flat_street(6000);
  for (int i = 0; i < 40; ++i) cloud.push_back({5 + 0.1f * static_cast<float>(i % 7), 1, -8});

  const Segmentation kept = segment(cloud, {.noise_factor = inf});
  const Segmentation removed = segment(cloud);

  EXPECT_EQ(kept.count(Label::noise), 0u);
  EXPECT_LT(kept.count(Label::ground), 5000u);
  EXPECT_EQ(removed.count(Label::noise), 40u);
  EXPECT_EQ(removed.count(Label::ground), 6000u);
}

TEST(Gpf, LabelsGroundOfASteepDescentAsNoise) {
  const std::vector<Point> descent =
      street(6000, [](float x) { return -1.73f - 0.1f * std::max(0.0f, x); });

  const Segmentation result = segment(descent);

  EXPECT_GT(result.count(Label::noise), 2000u);
}

TEST(Gpf, TheFirstPlaneIsFittedToTheSeeds) {
  const std::vector<Point> cloud = rise();
  std::vector<float> heights;
  for (const Point& p : cloud) heights.push_back(p.z);
  std::ranges::sort(heights);
  double representative = 0;  // mean of N_LPR = 20 points
  for (std::size_t i = 0; i < 20; ++i) representative += heights[i] / 20.0;
  double sum = 0;
  double seeds = 0;
  for (const Point& p : cloud) {
    if (p.z >= representative + 0.4f) continue;  // Th_seeds
    sum += p.x;
    seeds += 1;
  }

  const Segmentation result = segment(cloud, {.segments = 1, .seed_height = 0.4f, .iterations = 1});

  ASSERT_EQ(result.patches().size(), 1u);
  EXPECT_NEAR(result.patches()[0].mean[0], sum / seeds, 1e-4);
}

TEST(Gpf, MoreIterationsFindMoreGround) {
  const std::vector<Point> cloud = rise();
  std::size_t before = 0;
  for (const int iterations : {1, 2, 3}) {
    const std::size_t ground =
        segment(cloud, {.segments = 1, .iterations = iterations}).count(Label::ground);
    EXPECT_GT(ground, before);
    before = ground;
  }
}

TEST(Gpf, GroundEndsAtTheMarginAboveThePlaneAndHasNoLowerBound) {
  std::vector<Point> cloud = flat_street(6000);
  for (const float off : {0.15f, 0.25f, -0.25f, -0.8f}) cloud.push_back({1, 1, -1.73f + off});

  const Segmentation result = segment(cloud);

  EXPECT_THAT(std::vector(result.labels().end() - 4, result.labels().end()),
              testing::ElementsAre(Label::ground, Label::nonground, Label::ground, Label::ground));
}

TEST(Gpf, WallsAreNotGround) {
  Random random(2);
  std::vector<Point> cloud = flat_street(6000);
  for (int i = 0; i < 4000; ++i) {
    cloud.push_back({uniform(random, -60, 60), 11, uniform(random, -1.4, 5)});
  }

  const Segmentation result = segment(cloud);

  EXPECT_EQ(std::ranges::count(result.labels().first(6000), Label::ground), 6000);
  EXPECT_EQ(std::ranges::count(result.labels().last(4000), Label::ground), 0);
}

TEST(Gpf, ASegmentWithTwoPointsHasNoPlane) {
  std::vector<Point> cloud = flat_street(6000);
  std::erase_if(cloud, [](const Point& p) { return p.x >= 20; });
  cloud.push_back({30, 0, -1.7f});
  cloud.push_back({40, 0, -1.7f});

  const Segmentation result = segment(cloud);

  ASSERT_EQ(result.patches().size(), 3u);
  EXPECT_EQ(result.patches()[2].verdict, Verdict::no_plane);
  EXPECT_EQ(result.labels().back(), Label::nonground);
}

TEST(Gpf, AMovedSegmenterStillWorks) {
  const std::vector<Point> cloud = tests::random_cloud(3000, 3);
  Gpf original;
  Gpf moved = std::move(original);
  Segmentation result;

  ASSERT_TRUE(moved.segment(tests::view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), segment(cloud).labels()));
}

TEST(Gpf, RejectsSettingsOutOfRangeByName) {
  const auto message_of = [](const GpfConfig& config) -> std::string {
    try {
      Gpf refused(config);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };

  EXPECT_THAT(message_of({.sensor_height = 0}), testing::StartsWith("gpf: sensor_height = 0"));
  EXPECT_THAT(message_of({.noise_factor = 0.5f}), testing::StartsWith("gpf: noise_factor = 0.5"));
  EXPECT_THAT(message_of({.segments = 0}), testing::StartsWith("gpf: segments = 0"));
  EXPECT_THAT(message_of({.segment_length = 0}), testing::StartsWith("gpf: segment_length = 0"));
  EXPECT_THAT(message_of({.lowest_points = 0}), testing::StartsWith("gpf: lowest_points = 0"));
  EXPECT_THAT(message_of({.seed_height = -1}), testing::StartsWith("gpf: seed_height = -1"));
  EXPECT_THAT(message_of({.iterations = 0}), testing::StartsWith("gpf: iterations = 0"));
  EXPECT_THAT(message_of({.distance_margin = 0}), testing::StartsWith("gpf: distance_margin = 0"));
  EXPECT_EQ(message_of({}), "");
}

}  // namespace
}  // namespace flagstone
