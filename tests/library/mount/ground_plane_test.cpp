// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/ground_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace flagstone::mount {
namespace {

/// Adds points of weight 1 in a square of 8 m around the sensor, `count` along each side.
void add_level(std::vector<NearPoint>& points, float height, int count) {
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const auto along = [&](int i) {
        return 8 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 4;
      };
      points.push_back({along(column), along(row), -height, 1});
    }
  }
}

float height_found(const std::vector<NearPoint>& points) {
  PlaneSearch search(MountLimits{}, false);
  const std::optional<GroundPlane> plane = search.find(points, 0);
  return plane ? plane->height : 0;
}

TEST(PlaneSearch, FindsALevel) {
  std::vector<NearPoint> points;
  add_level(points, 1.7f, 20);
  EXPECT_NEAR(height_found(points), 1.7f, 0.01f);
}

TEST(PlaneSearch, PrefersTheLowerOfTwoLevelsUnlessItHasLessThanAThirdOfTheUpperPoints) {
  std::vector<NearPoint> points;  // a point below a level cancels two points in it
  add_level(points, 1, 31);       // 961 points
  std::vector<NearPoint> few = points;
  add_level(points, 2, 20);  // 1 / 2.4
  add_level(few, 2, 16);     // 1 / 3.8

  EXPECT_NEAR(height_found(points), 2, 0.01f);
  EXPECT_NEAR(height_found(few), 1, 0.01f);
}

TEST(PlaneSearch, FindsTiltedGroundBelowALevelHedge) {
  // The hedge, 0.4 m above the ground, has so many points that a first test of directions 10
  // degrees apart would select it. Directions 5 degrees apart do not.
  std::vector<NearPoint> points;
  add_level(points, 1.7f, 40);
  for (NearPoint& p : points) p.z -= 2 * 0.0875f * (p.x + p.y);
  add_level(points, 1.3f, 40);
  for (NearPoint& p : points) {  // up to 8 m from the sensor
    p.x *= 2;
    p.y *= 2;
  }

  PlaneSearch search(MountLimits{}, true);
  const std::optional<GroundPlane> plane = search.find(points, 0);

  ASSERT_TRUE(plane);
  const float shorter = 1 / std::sqrt(1 + 2 * 0.0875f * 0.0875f);
  EXPECT_NEAR(plane->up[0], 0.0875f * shorter, 0.003f);
  EXPECT_NEAR(plane->up[1], 0.0875f * shorter, 0.003f);
  EXPECT_NEAR(plane->height, 1.7f * shorter, 0.01f);
}

/// A decision whose values are all good.
MountDecision sure() {
  return {.cells = 25, .free = 0.5f, .below = 0.2f, .spread = 0.12f, .directions = 9, .seen = 15};
}

TEST(MountConfidence, IsFullIfEveryValueIsGood) {
  MountDecision decision = sure();
  judge(decision, 0.99f);
  EXPECT_FLOAT_EQ(decision.confidence, 1);
  EXPECT_EQ(decision.verdict, MountVerdict::accepted);
}

TEST(MountConfidence, IsHalfForAValueHalfwayAndGivesTheReason) {
  struct Case {
    const char* what;
    MountVerdict reason;
    void (*spoil)(MountDecision&);
  };
  const std::vector<Case> cases = {
      {"cells", MountVerdict::too_few_points, [](MountDecision& d) { d.cells = 15; }},
      {"free", MountVerdict::obstructed, [](MountDecision& d) { d.free = 0.35f; }},
      {"below", MountVerdict::points_below, [](MountDecision& d) { d.below = 0.35f; }},
      {"spread", MountVerdict::no_plane, [](MountDecision& d) { d.spread = 0.185f; }},
      {"directions seen", MountVerdict::one_sided, [](MountDecision& d) { d.seen = 20; }},
  };
  for (const auto& [what, reason, spoil] : cases) {
    MountDecision decision = sure();
    spoil(decision);
    judge(decision, 0.51f);
    EXPECT_NEAR(decision.confidence, 0.5f, 1e-5f) << what;
    EXPECT_EQ(decision.verdict, reason) << what;
    judge(decision, 0.49f);
    EXPECT_EQ(decision.verdict, MountVerdict::accepted) << what;
  }
}

TEST(MountSentence, ReportsATiltThatRoundsToATenthOfADegree) {
  MountDecision decision = sure();
  decision.verdict = MountVerdict::accepted;
  decision.tilt = 0.05f;
  EXPECT_NE(to_sentence(decision).find("tilted by 0.1 degrees"), std::string::npos);
  decision.tilt = 0.04f;
  EXPECT_EQ(to_sentence(decision).find("tilted"), std::string::npos);
}

TEST(MountConfidence, RequiresGroundInThreeDirections) {
  MountDecision decision = sure();
  decision.directions = decision.seen = 2;
  judge(decision, 0.9f);
  EXPECT_NEAR(decision.confidence, 2.0f / 3, 1e-5f);
  EXPECT_EQ(decision.verdict, MountVerdict::one_sided);
}

}  // namespace
}  // namespace flagstone::mount
