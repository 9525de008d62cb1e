// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/patch_judge.hpp"

namespace flagstone::surface {
namespace {

/// A patch with many points.
FittedPatch patch_at(float x, float y, float z, float slope_x = 0, float slope_y = 0) {
  return {.x = x, .y = y, .z = z, .slope_x = slope_x, .slope_y = slope_y, .points = 100};
}

AcceptedPatches accepted(const std::vector<FittedPatch>& list) {
  AcceptedPatches patches;
  patches.reserve(list.size());
  for (const FittedPatch& patch : list) patches.add(patch);
  return patches;
}

/// The parameter is the instruction set.
class AcceptedPatchesOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, AcceptedPatchesOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(AcceptedPatchesOn, HasNoNeighbourWithoutPatches) {
  AcceptedPatches patches;
  patches.reserve(4);

  EXPECT_FALSE(patches.fit(patch_at(10, 0, -1.7f), 1000).has_neighbour);
}

TEST_P(AcceptedPatchesOn, UsesOnlyNeighboursWithinTheRadius) {
  const AcceptedPatches patches = accepted({patch_at(10, 0, -1.7f)});

  EXPECT_TRUE(patches.fit(patch_at(13, 4, -1.7f), 5.01f).has_neighbour);
  EXPECT_FALSE(patches.fit(patch_at(13, 4, -1.7f), 4.99f).has_neighbour);
}

TEST_P(AcceptedPatchesOn, DistanceIsMeasuredToTheNearestNeighbour) {
  const AcceptedPatches patches =
      accepted({patch_at(10, 0, -1.7f), patch_at(6, 0, -1.7f), patch_at(0, 5, -1.7f)});

  EXPECT_FLOAT_EQ(patches.fit(patch_at(10, 3, -1.7f), 20).distance, 3);
}

TEST_P(AcceptedPatchesOn, LevelNeighboursPredictTheirMeanHeight) {
  const AcceptedPatches patches = accepted({patch_at(8, 0, -1.6f), patch_at(12, 0, -1.8f)});

  EXPECT_NEAR(patches.fit(patch_at(10, 0, -1.2f), 8).step, 0.5f, 1e-5f);
}

TEST_P(AcceptedPatchesOn, NearerNeighboursHaveMoreWeight) {
  const AcceptedPatches patches = accepted({patch_at(8, 0, -1.7f), patch_at(16, 0, -0.7f)});

  const float step = patches.fit(patch_at(10, 0, -1.7f), 10).step;

  EXPECT_LT(step, 0);
  EXPECT_GT(step, -0.1f);
}

TEST_P(AcceptedPatchesOn, PatchesWithMorePointsHaveMoreWeight) {
  FittedPatch poor = patch_at(8, 0, -0.7f);
  poor.points = 5;
  const AcceptedPatches patches = accepted({poor, patch_at(12, 0, -1.7f)});

  EXPECT_GT(patches.fit(patch_at(10, 0, -1.2f), 8).step, 0.2f);
}

TEST_P(AcceptedPatchesOn, SlopesAreReducedToThreeQuarters) {
  const AcceptedPatches patches = accepted({patch_at(10, 0, -1.7f, 0.2f, 0)});

  // A level patch 4 m up or down the slope. Its curve would predict half of this step.
  EXPECT_NEAR(patches.fit(patch_at(14, 0, -1.7f + 0.6f), 8).step, 0, 1e-6f);
  EXPECT_NEAR(patches.fit(patch_at(6, 0, -1.7f - 0.6f), 8).step, 0, 1e-6f);
}

TEST_P(AcceptedPatchesOn, GroundContinuesAtTheBaseOfABank) {
  // Level ground, then a bank that curves up to a slope of 0.4 at 4 m. It has risen by half of
  // slope times distance, reduced to three quarters.
  const AcceptedPatches patches = accepted({patch_at(10, 0, -1.7f)});

  EXPECT_NEAR(patches.fit(patch_at(14, 0, -1.7f + 0.6f, 0.4f, 0), 8).step, 0, 1e-6f);
  // If level ground is predicted and found, the curve does not matter.
  EXPECT_NEAR(patches.fit(patch_at(14, 0, -1.7f, 0.4f, 0), 8).step, 0, 1e-6f);
  // A level roof at that height is a step.
  EXPECT_NEAR(patches.fit(patch_at(14, 0, -1.7f + 0.6f), 8).step, 0.6f, 1e-6f);
}

TEST_P(AcceptedPatchesOn, MatchesANaiveSum) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> position(-60, 60);
  std::uniform_real_distribution<float> height(-3, 1);
  std::uniform_real_distribution<float> slope(-0.4f, 0.4f);
  for (const std::size_t count : {1U, 2U, 15U, 16U, 17U, 100U, 500U}) {
    std::vector<FittedPatch> list;
    for (std::size_t i = 0; i < count; ++i) {
      list.push_back(patch_at(position(random), position(random), height(random), slope(random),
                              slope(random)));
      list.back().points = 5 + static_cast<float>(random() % 100);
    }
    const AcceptedPatches patches = accepted(list);
    ASSERT_EQ(patches.size(), count);
    for (int repeat = 0; repeat < 50; ++repeat) {
      const FittedPatch patch = patch_at(position(random), position(random), height(random),
                                         slope(random), slope(random));
      double weights = 0;
      double straight = 0;
      double curved = 0;
      double nearest = 1e9;
      for (const FittedPatch& other : list) {
        const auto dx = static_cast<double>(patch.x - other.x);
        const auto dy = static_cast<double>(patch.y - other.y);
        const double distance = std::hypot(dx, dy);
        if (distance > 20) continue;
        const auto points = static_cast<double>(other.points);
        const double near = 1 + distance * distance;
        const double weight = points / (points + 20) / (near * near);
        const double rise =
            dx * static_cast<double>(other.slope_x) + dy * static_cast<double>(other.slope_y);
        const double own =
            dx * static_cast<double>(patch.slope_x) + dy * static_cast<double>(patch.slope_y);
        weights += weight;
        straight += weight * (static_cast<double>(other.z) + 0.75 * rise);
        curved += weight * (static_cast<double>(other.z) + 0.75 * (rise + own) / 2);
        nearest = std::min(nearest, distance);
      }

      const AcceptedPatches::Fit fit = patches.fit(patch, 20);

      ASSERT_EQ(fit.has_neighbour, weights > 0);
      if (weights <= 0) continue;
      EXPECT_NEAR(fit.distance, nearest, 1e-4);
      const double above_straight = static_cast<double>(patch.z) - straight / weights;
      const double above_curved = static_cast<double>(patch.z) - curved / weights;
      const double closer =
          std::abs(above_curved) < std::abs(above_straight) ? above_curved : above_straight;
      EXPECT_NEAR(fit.step, closer, 1e-4);
    }
  }
}

TEST_P(AcceptedPatchesOn, ContradictTheRoofOfACar) {
  const FittedPatch roof = patch_at(10, 4, -0.4f);
  const AcceptedPatches patches =
      accepted({patch_at(10, 0, -1.7f), patch_at(14, 4, -1.7f), patch_at(10, 8, -1.7f), roof});

  EXPECT_TRUE(patches.contradict(roof, 8));
  EXPECT_FALSE(patches.contradict(patch_at(10, 0, -1.7f), 8));
}

TEST_P(AcceptedPatchesOn, DoNotContradictATerrace) {
  // As many patches on the terrace as below it
  const FittedPatch edge = patch_at(10, 4, -0.4f);
  const AcceptedPatches patches =
      accepted({patch_at(6, 0, -1.7f), patch_at(10, 0, -1.7f), patch_at(14, 0, -1.7f), edge,
                patch_at(6, 4, -0.4f), patch_at(14, 4, -0.4f)});

  EXPECT_FALSE(patches.contradict(edge, 8));
}

TEST_P(AcceptedPatchesOn, DoNotContradictASlopeOrALowerPatch) {
  EXPECT_FALSE(accepted({patch_at(10, 0, -1.7f, 0.3f, 0)})
                   .contradict(patch_at(14, 0, -1.7f + 1.2f, 0.3f, 0), 8));
  EXPECT_FALSE(accepted({patch_at(10, 0, -1.7f)}).contradict(patch_at(14, 0, -5), 8));
}

TEST_P(AcceptedPatchesOn, ContradictOnlyWithinTheRadius) {
  const AcceptedPatches patches = accepted({patch_at(10, 0, -1.7f)});

  EXPECT_TRUE(patches.contradict(patch_at(13, 4, 0), 5.01f));
  EXPECT_FALSE(patches.contradict(patch_at(13, 4, 0), 4.99f));
}

TEST_P(AcceptedPatchesOn, ClearRemovesAllPatches) {
  AcceptedPatches patches = accepted(std::vector<FittedPatch>(40, patch_at(10, 0, 5)));

  patches.clear();
  patches.add(patch_at(12, 0, -1.7f));

  EXPECT_EQ(patches.size(), 1U);
  EXPECT_NEAR(patches.fit(patch_at(12, 2, -1.7f), 8).step, 0, 1e-6f);
}

}  // namespace
}  // namespace flagstone::surface
