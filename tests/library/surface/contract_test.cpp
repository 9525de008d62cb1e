// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// The data contract of `surface`. tests/lab/baselines tests the contract of all methods.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

#include "flagstone/flagstone.hpp"
#include "numbers.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::view_of;

std::vector<Label> labels_of(const std::vector<Point>& cloud, const SurfaceConfig& config = {}) {
  return tests::segmented(config, view_of(cloud)).labels;
}

TEST(SurfaceContract, PointsBeyondMaxRangeAreOutOfRange) {
  EXPECT_EQ(labels_of({{100.1f, 0, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{-80, 80, -1.7f}}), std::vector{Label::out_of_range});
  EXPECT_EQ(labels_of({{-60, 60, 3}}), std::vector{Label::nonground});
  SurfaceConfig near;
  near.max_range = 20;
  EXPECT_EQ(labels_of({{20.1f, 0, 3}, {19.9f, 0, 3}}, near),
            (std::vector{Label::out_of_range, Label::nonground}));
}

TEST(SurfaceContract, PointsNextToTheSensorAreLabelled) {
  std::vector<Point> cloud = random_cloud(64000, 3);
  cloud.push_back({0.4f, 0.3f, -1.73f});
  cloud.push_back({0.4f, 0.3f, 0.2f});

  const std::vector<Label> labels = labels_of(cloud);

  EXPECT_EQ(labels[64000], Label::ground);
  EXPECT_EQ(labels[64001], Label::nonground);
}

TEST(SurfaceContract, HeightsAreFiniteOrNan) {
  const std::vector<Point> cloud = corrupted_cloud(30000, 3);

  const tests::Outcome outcome = tests::segmented(SurfaceConfig{}, view_of(cloud));

  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Label label = outcome.labels[i];
    const float height = outcome.heights[i];
    EXPECT_FALSE(std::isinf(height));
    if (label == Label::invalid || label == Label::out_of_range) {
      EXPECT_TRUE(std::isnan(height)) << i;
    }
    if (label == Label::ground) {
      EXPECT_FALSE(std::isnan(height)) << i;
    }
  }
}

TEST(SurfaceContract, GroundLiesBelowTheMarginAndAboveTheNoiseLimit) {
  const std::vector<Point> cloud = random_cloud(64000, 5);
  const PointRule rule;

  const tests::Outcome outcome = tests::segmented(SurfaceConfig{}, view_of(cloud));

  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float height = outcome.heights[i];
    const float deepest =
        -(rule.noise_depth + rule.noise_depth_per_metre * std::hypot(cloud[i].x, cloud[i].y));
    if (outcome.labels[i] == Label::ground) {
      ASSERT_LT(height, rule.margin);
      ASSERT_GT(height, deepest - 1e-4f);
    }
    if (outcome.labels[i] == Label::noise) {
      ASSERT_LE(height, deepest + 1e-4f);
    }
    if (height >= rule.margin) {
      ASSERT_EQ(outcome.labels[i], Label::nonground);
    }
    if (height < rule.obstacle_margin && height > deepest + 1e-4f) {
      ASSERT_EQ(outcome.labels[i], Label::ground);
    }
  }
  EXPECT_GT(std::ranges::count(outcome.labels, Label::noise), 0);
}

TEST(SurfaceContract, APatchIsASquareThatContainsItsGround) {
  const SurfaceConfig config;

  const tests::Outcome outcome = tests::segmented(config, view_of(corrupted_cloud(50000, 14)));

  std::size_t ground_patches = 0;
  for (const Patch& patch : outcome.patches) {
    EXPECT_GT(patch.point_count, 0U);
    EXPECT_LE(patch.ground_count, patch.point_count);
    EXPECT_LE(patch.zone, 1);
    EXPECT_NE(patch.verdict, Verdict::ground_flat);
    if (!patch.is_ground()) {
      EXPECT_EQ(patch.ground_count, 0U);
      continue;
    }
    ++ground_patches;
    const float size = patch.zone == 0 ? 4.0f : 8.0f;
    // The cells cover whole blocks of 8 m.
    const float edge = 8 * std::ceil(config.max_range / 8);
    EXPECT_NEAR(patch.mean[0], (patch.sector + 0.5f) * size - edge, 0.5f * size + 1e-3f);
    EXPECT_NEAR(patch.mean[1], (patch.ring + 0.5f) * size - edge, 0.5f * size + 1e-3f);
  }
  EXPECT_GT(ground_patches, 10U);
}

TEST(SurfaceContract, EveryPatchHasAMatchingVerdict) {
  const SurfaceConfig config;

  const tests::Outcome outcome = tests::segmented(config, view_of(random_cloud(64000, 9)));

  for (const Patch& patch : outcome.patches) {
    if (patch.verdict == Verdict::too_few_points) {
      EXPECT_LE(patch.point_count, 10U);
    }
    if (patch.verdict == Verdict::not_upright) {
      EXPECT_LT(patch.normal[2], std::sin(0.926f));
    }
    if (patch.is_ground()) {
      EXPECT_GT(patch.normal[2], std::sin(0.925f));  // 53 degrees
    }
  }
}

TEST(SurfaceContract, ACloudWithoutValidPointsHasNoPatches) {
  const tests::Outcome outcome =
      tests::segmented(SurfaceConfig{}, view_of(std::vector<Point>(1000, Point{nan, 0, 0})));

  EXPECT_TRUE(outcome.patches.empty());
  EXPECT_THAT(outcome.labels, testing::Each(Label::invalid));
}

TEST(SurfaceContract, TheSurfaceIsUnknownFarFromAnyGround) {
  std::vector<Point> cloud = random_cloud(20000, 2);
  std::erase_if(cloud, [](const Point& p) { return p.x > 0 || std::abs(p.y) > 40; });
  cloud.push_back({90, 0, 1});
  Surface segmenter;
  Segmentation result;

  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(std::isnan(result.surface().height(90, 0)));
  EXPECT_EQ(result.surface().at(90, 0).confidence, 0);
  EXPECT_TRUE(std::isnan(result.heights().back()));
  EXPECT_EQ(result.labels().back(), Label::nonground);
  EXPECT_FALSE(std::isnan(result.surface().height(-10, 0)));
}

TEST(SurfaceContract, ConfidenceIsZeroForUnknownHeightsAndAtMostOne) {
  const tests::Outcome outcome =
      tests::segmented(SurfaceConfig{}, view_of(corrupted_cloud(30000, 4)));

  for (const GroundSurface::Grid& grid : outcome.grids) {
    ASSERT_EQ(grid.heights.size(), grid.width * grid.width);
    ASSERT_EQ(grid.confidences.size(), grid.width * grid.width);
    for (std::size_t i = 0; i < grid.heights.size(); ++i) {
      ASSERT_EQ(std::isnan(grid.heights[i]), grid.confidences[i] == 0) << i;
      ASSERT_LE(grid.confidences[i], 1);
    }
  }
}

TEST(SurfaceContract, AWallAloneGivesValidHeightsEvenIfAnyAngleIsUpright) {
  SurfaceConfig config;
  config.acceptance.upright_angle = 0;
  std::vector<Point> wall;
  for (float up = 0; up < 0.8f; up += 0.2f) {
    for (float y = 0; y < 2; y += 0.004f) wall.push_back({10, y, -1.7f + up});
  }

  const tests::Outcome outcome = tests::segmented(config, view_of(wall));

  for (const GroundSurface::Grid& grid : outcome.grids) {
    for (std::size_t i = 0; i < grid.heights.size(); ++i) {
      ASSERT_EQ(std::isnan(grid.heights[i]), grid.confidences[i] == 0);
    }
  }
}

TEST(SurfaceContract, GridsAreFinerNearTheSensorAndCoverTheRange) {
  for (const int levels : {0, 1, 2, 3, 4}) {
    for (const float range : {8.0f, 20.0f, 100.0f, 200.0f}) {
      SurfaceConfig config;
      config.refinement.levels = levels;
      config.max_range = range;

      const tests::Outcome outcome = tests::segmented(config, view_of(random_cloud(3000, 1)));

      ASSERT_EQ(outcome.grids.size(), static_cast<std::size_t>(std::max(levels, 1)));
      EXPECT_GE(outcome.grids.front().extent(), range);
      for (std::size_t i = 0; i < outcome.grids.size(); ++i) {
        EXPECT_EQ(outcome.grids[i].cell, std::ldexp(2.0f, -static_cast<int>(i)));
        EXPECT_EQ(outcome.grids[i].width % 2, 0U);
        if (i > 0) {
          EXPECT_LE(outcome.grids[i].extent(), outcome.grids[i - 1].extent());
        }
      }
    }
  }
}

TEST(SurfaceContract, TheSurfaceHasNoStepIfTheRangeEndsWithAFineGrid) {
  std::mt19937 random(1);
  for (const float range : {8.0f, 16.0f, 32.0f, 40.0f}) {
    std::uniform_real_distribution<float> position(-range, range);
    std::vector<Point> cloud(60000);
    for (Point& p : cloud) {
      p = {.x = position(random), .y = position(random), .z = 0};
      p.z = 0.15f * std::sin(0.8f * p.x) + 0.1f * std::sin(0.9f * p.y) + 0.05f * p.x - 1.73f;
    }
    SurfaceConfig config;
    config.max_range = range;
    Surface segmenter(config);
    Segmentation result;

    ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

    const GroundSurface& surface = result.surface();
    for (float y = -range / 2; y < range / 2; y += 0.1f) {
      for (float x = range - 1; x < range - 0.01f; x += 0.01f) {
        ASSERT_LT(std::abs(surface.height(x + 0.01f, y) - surface.height(x, y)), 0.03f)
            << "range " << range << ", " << x << ", " << y;
      }
    }
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (std::isnan(result.heights()[i])) continue;
      ASSERT_EQ(result.heights()[i], cloud[i].z - surface.height(cloud[i].x, cloud[i].y));
    }
  }
}

TEST(SurfaceContract, RejectsASettingOutOfRange) {
  SurfaceConfig config;
  config.max_range = 7.9f;

  EXPECT_THROW(Surface{config}, std::invalid_argument);
}

TEST(SurfaceContract, ReplacesAResultOfAnotherMethod) {
  const std::vector<Point> cloud = random_cloud(9000, 15);
  Segmentation result;
  Patchwork patchwork;
  Surface segmenter;
  ASSERT_TRUE(segmenter.segment(view_of(cloud), result).ok());

  ASSERT_TRUE(patchwork.segment(view_of(cloud), result).ok());

  EXPECT_TRUE(result.surface().empty());
  EXPECT_TRUE(result.heights().empty());
}

}  // namespace
}  // namespace flagstone
