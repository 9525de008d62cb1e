// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Properties from Fischler and Bolles (1981), and known failures of a single plane.
#include "flagstone/baselines/ransac.hpp"

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

#include "lab/baselines/ransac_search.hpp"
#include "library/core/random.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using baselines::Coordinates;
using baselines::RansacSearch;
using baselines::search_plane;
using baselines::SinglePrecisionPlane;
using baselines::trials_needed;

constexpr float slope_x = 0.05f;
constexpr float slope_y = -0.02f;

float street_height(float x, float y) { return -1.73f + slope_x * x + slope_y * y; }

float uniform(Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

/// A tilted street with noise of up to 3 cm. A fraction `outliers` of the points is replaced by
/// points within 40 m and up to 10 m above the street.
std::vector<Point> street(std::size_t points, double outliers, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const float x = uniform(random, -40, 40);
    const float y = uniform(random, -40, 40);
    const bool is_outlier = static_cast<double>(i) < outliers * static_cast<double>(points);
    const float above = is_outlier ? uniform(random, 0.3, 10) : uniform(random, -0.03, 0.03);
    cloud.push_back({x, y, street_height(x, y) + above});
  }
  return cloud;
}

/// x, y and z of a cloud in separate arrays.
struct Packed {
  explicit Packed(const std::vector<Point>& cloud) {
    for (const Point& p : cloud) {
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
    }
  }
  [[nodiscard]] Coordinates coordinates() const { return {x, y, z}; }

  std::vector<float> x, y, z;
};

Segmentation segment(const std::vector<Point>& cloud, const RansacConfig& config = {}) {
  Segmentation result;
  EXPECT_TRUE(Ransac(config).segment(tests::view_of(cloud), result).ok());
  return result;
}

/// Sine of the angle between a normal and the normal of the street.
double tilt(double x, double y, double z) {
  const double length = std::sqrt(slope_x * slope_x + slope_y * slope_y + 1);
  const double cosine = (-slope_x * x - slope_y * y + z) / length;
  return std::sqrt(std::max(0.0, 1 - cosine * cosine));
}

double tilt(const Patch& patch) { return tilt(patch.normal[0], patch.normal[1], patch.normal[2]); }

TEST(Ransac, FindsThePlaneAmongSixtyPercentOutliers) {
  const Segmentation result = segment(street(10000, 0.6, 1));

  ASSERT_EQ(result.patches().size(), 1u);
  EXPECT_EQ(result.patches()[0].verdict, Verdict::ground);
  EXPECT_LT(tilt(result.patches()[0]), 0.001);
  EXPECT_NEAR(result.patches()[0].d / result.patches()[0].normal[2], 1.73, 0.01);
  EXPECT_EQ(std::ranges::count(result.labels().first(6000), Label::ground), 0);
  EXPECT_EQ(std::ranges::count(result.labels().last(4000), Label::ground), 4000);
}

TEST(Ransac, NumberOfTrialsFollowsSectionIIB) {
  for (const double confidence : {0.5, 0.9, 0.99, 0.999}) {
    for (const double share : {0.1, 0.2, 0.4, 0.6, 0.8, 0.95}) {
      const double k = std::log(1 - confidence) / std::log(1 - std::pow(share, 3));

      EXPECT_EQ(trials_needed(share, confidence, 1000000), static_cast<int>(std::ceil(k)))
          << "w = " << share << ", z = " << confidence;
    }
  }
}

TEST(Ransac, NumberOfTrialsIsOneForInliersOnlyAndTheMaximumWithoutInliers) {
  EXPECT_EQ(trials_needed(1, 0.99, 1000), 1);
  EXPECT_EQ(trials_needed(0, 0.99, 1000), 1000);
}

TEST(Ransac, NumberOfTrialsDecreasesWithTheFractionOfInliers) {
  int before = 1001;
  for (const double outliers : {0.8, 0.6, 0.4, 0.2}) {
    const Packed cloud(street(5000, outliers, 2));
    const RansacSearch search = search_plane(cloud.coordinates(), {});

    const double share = static_cast<double>(search.consensus) / 5000;
    EXPECT_EQ(search.trials, trials_needed(share, 0.99f, 1000)) << outliers;
    EXPECT_LT(search.trials, before);
    before = search.trials;
  }
}

TEST(Ransac, TrialsEndAtTheMaximumWithoutAPlane) {
  Random random(3);
  std::vector<Point> anywhere(2000);
  for (Point& p : anywhere) {
    p = {uniform(random, -50, 50), uniform(random, -50, 50), uniform(random, -50, 50)};
  }

  EXPECT_EQ(search_plane(Packed(anywhere).coordinates(), {.max_trials = 77}).trials, 77);
}

TEST(Ransac, TheSeedDeterminesTheSamples) {
  const Packed cloud(street(5000, 0.4, 4));

  const RansacSearch first = search_plane(cloud.coordinates(), {.seed = 1});
  const RansacSearch again = search_plane(cloud.coordinates(), {.seed = 1});
  const RansacSearch other = search_plane(cloud.coordinates(), {.seed = 2});

  EXPECT_EQ(first.plane.d, again.plane.d);
  EXPECT_EQ(first.consensus, again.consensus);
  EXPECT_NE(first.plane.d, other.plane.d);
}

TEST(Ransac, ThePlaneDoesNotDependOnTheSeed) {
  const std::vector<Point> cloud = street(10000, 0.5, 5);

  for (int seed = 0; seed < 20; ++seed) {
    const Segmentation result = segment(cloud, {.seed = seed});

    EXPECT_LT(tilt(result.patches()[0]), 0.001);
    EXPECT_NEAR(result.patches()[0].d / result.patches()[0].normal[2], 1.73, 0.01);
  }
}

TEST(Ransac, LeastSquaresOnTheConsensusSetImprovesTheBestSample) {
  const std::vector<Point> cloud = street(5000, 0.5, 6);
  const Packed packed(cloud);
  double of_samples = 0;
  double of_fits = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const SinglePrecisionPlane sample = search_plane(packed.coordinates(), {.seed = seed}).plane;
    of_samples += tilt(sample.normal_x, sample.normal_y, sample.normal_z);
    of_fits += tilt(segment(cloud, {.seed = seed}).patches()[0]);
  }

  EXPECT_LT(of_fits, of_samples / 2);
}

TEST(Ransac, TheThresholdAppliesOnBothSidesOfThePlane) {
  std::vector<Point> cloud = street(4000, 0, 7);
  for (const float off : {0.15f, -0.15f, 0.25f, -0.25f, -9.0f}) {
    cloud.push_back({10, 10, street_height(10, 10) + off});
  }

  const Segmentation result = segment(cloud);

  EXPECT_THAT(std::vector(result.labels().end() - 5, result.labels().end()),
              testing::ElementsAre(Label::ground, Label::ground, Label::nonground, Label::nonground,
                                   Label::nonground));
}

TEST(Ransac, LabelsAWallLargerThanTheGroundAsGround) {
  Random random(8);
  std::vector<Point> cloud = street(4000, 0, 8);
  for (int i = 0; i < 8000; ++i) {
    cloud.push_back({uniform(random, -40, 40), 12, uniform(random, -2, 10)});
  }

  const Segmentation result = segment(cloud);

  EXPECT_LT(result.patches()[0].normal[2], 0.1f);
  EXPECT_EQ(std::ranges::count(result.labels().last(8000), Label::ground), 8000);
  EXPECT_LT(std::ranges::count(result.labels().first(4000), Label::ground), 100);
}

TEST(Ransac, RejectsAPlaneWithTooFewInliers) {
  const std::vector<Point> eight = street(8, 0, 9);
  const std::vector<Point> seven(eight.begin(), eight.end() - 1);

  EXPECT_EQ(segment(eight).count(Label::ground), 8u);
  EXPECT_EQ(segment(seven).count(Label::nonground), 7u);
  EXPECT_EQ(segment(seven).patches()[0].verdict, Verdict::no_plane);
}

TEST(Ransac, CollinearPointsGiveNoPlane) {
  std::vector<Point> line;
  for (int i = 1; i <= 100; ++i) line.push_back({static_cast<float>(i), 0, 0});

  EXPECT_EQ(segment(line).count(Label::nonground), 100u);
}

TEST(Ransac, AMovedSegmenterStillWorks) {
  const std::vector<Point> cloud = street(1000, 0.2, 10);
  Ransac original;
  Ransac moved = std::move(original);
  Segmentation result;

  ASSERT_TRUE(moved.segment(tests::view_of(cloud), result).ok());

  EXPECT_TRUE(std::ranges::equal(result.labels(), segment(cloud).labels()));
}

TEST(Ransac, RejectsSettingsOutOfRangeByName) {
  const auto message_of = [](const RansacConfig& config) -> std::string {
    try {
      Ransac refused(config);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };

  EXPECT_THAT(message_of({.distance_threshold = 0}),
              testing::StartsWith("ransac: distance_threshold = 0"));
  EXPECT_THAT(message_of({.confidence = 1}), testing::StartsWith("ransac: confidence = 1"));
  EXPECT_THAT(message_of({.max_trials = 0}), testing::StartsWith("ransac: max_trials = 0"));
  EXPECT_THAT(message_of({.min_consensus = 2}), testing::StartsWith("ransac: min_consensus = 2"));
  EXPECT_THAT(message_of({.seed = -1}), testing::StartsWith("ransac: seed = -1"));
  EXPECT_EQ(message_of({}), "");
}

}  // namespace
}  // namespace flagstone
