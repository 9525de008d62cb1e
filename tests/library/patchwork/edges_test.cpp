// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Patchwork on ground with two levels, and with reflections below the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "edge_scan.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::Outcome;
using tests::segmented;
using tests::share_of;
using tests::view_of;

bool is_level(const Point& p) { return p.y < 5; }
bool is_below(const Point& p) { return p.z < -1.73f - 0.4f; }
bool is_behind(const Point& p) { return p.y > 5.1f; }

TEST(PatchworkAtEdges, BothSidesOfAKerbAreGround) {
  const std::vector<Point> cloud = tests::edge_scan(tests::step_of(0.15f));
  const Outcome outcome = segmented(PatchworkConfig{}, view_of(cloud));
  EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_level), 0.99);
  EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_behind), 0.99);
}

TEST(PatchworkAtEdges, BothSidesOfADropAreGround) {
  for (const float depth : {0.6f, 1.0f, 1.5f, 2.0f}) {
    const std::vector<Point> cloud = tests::edge_scan(tests::step_of(-depth));
    const Outcome outcome = segmented(PatchworkConfig{}, view_of(cloud));
    EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_level), 0.97) << depth;
    EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_below), 0.97) << depth;
  }
}

TEST(PatchworkAtEdges, TheBottomOfADitchIsNotNoiseAndMostOfItIsGround) {
  const std::vector<Point> cloud = tests::edge_scan(tests::ditch_of(0.6f));
  const Outcome outcome = segmented(PatchworkConfig{}, view_of(cloud));
  const auto is_bottom = [](const Point& p) { return p.z < -1.73f - 0.59f; };
  EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_bottom), 0.75);
  EXPECT_LT(share_of(Label::noise, cloud, outcome.labels, is_bottom), 0.01);
}

TEST(PatchworkAtEdges, SingleGhostPointsAreNeverGround) {
  std::vector<Point> cloud = tests::edge_scan(tests::step_of(0));
  const std::size_t first_ghost = cloud.size();
  tests::add_ghosts(cloud, 150);
  const Outcome outcome = segmented(PatchworkConfig{}, view_of(cloud));
  for (std::size_t i = first_ghost; i < cloud.size(); ++i) {
    EXPECT_NE(outcome.labels[i], Label::ground) << cloud[i].z;
  }
}

/// A bin of Z1 with ground, and `count` points around 1 m below it on `rows` rows of 2 m, each at
/// the distance `off_level` from that level. Points below the height margin are excluded from the
/// first set, so that the plane is fitted to the upper level.
template <class OffLevel>
Outcome of_ground_above(int count, int rows, const OffLevel& off_level,
                        PatchworkConfig config = {}) {
  config.keep_below_margin = false;
  std::vector<Point> cloud;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k) {
      const auto x = static_cast<float>(i);
      const auto y = static_cast<float>(k);
      cloud.push_back({6.45f + 0.05f * x, 0.3f + 0.05f * y, -1.73f + 0.004f * std::sin(x + 2 * y)});
    }
  }
  for (int i = 0; i < count; ++i) {
    const int column = i / rows;
    const auto along = static_cast<float>(column * rows);
    const float across = 0.3f * static_cast<float>(i % rows);
    cloud.push_back({7.6f + across + 0.02f * std::cos(5.0f * static_cast<float>(i)),
                     0.3f + 2 * along / static_cast<float>(count), -2.73f + off_level(i)});
  }
  return segmented(config, view_of(cloud));
}

float rough(int i) { return 0.004f * std::sin(37.0f * static_cast<float>(i)); }
float scattered(int i) { return 0.5f * std::sin(37.0f * static_cast<float>(i)); }

TEST(PatchworkBelowAPatch, PointsThatFormASeparatePlaneAreGroundAndCounted) {
  const Outcome outcome = of_ground_above(30, 3, rough);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::ground), 430);
  ASSERT_EQ(outcome.patches.size(), 1U);
  EXPECT_EQ(outcome.patches[0].ground_count, 430U);
  EXPECT_EQ(outcome.patches[0].lower_ground_count, 30U);
  EXPECT_NEAR(outcome.patches[0].mean[2], -1.73f, 0.01f);
}

TEST(PatchworkBelowAPatch, PointsThatFormNoPlaneAreNoise) {
  const Outcome outcome = of_ground_above(30, 3, scattered);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::noise), 30);
  EXPECT_EQ(outcome.patches[0].lower_ground_count, 0U);
}

TEST(PatchworkBelowAPatch, FewPointsAreNoise) {
  const Outcome outcome = of_ground_above(11, 3, rough);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::noise), 11);
}

TEST(PatchworkBelowAPatch, ALongLineOfOneBeamIsGround) {
  const Outcome outcome = of_ground_above(30, 1, rough);
  EXPECT_EQ(outcome.patches[0].lower_ground_count, 30U);
}

TEST(PatchworkBelowAPatch, AnInfiniteLowerPlaneMarginDisablesTheSearch) {
  PatchworkConfig config;
  config.lower_plane_margin = std::numeric_limits<float>::infinity();
  const Outcome outcome = of_ground_above(30, 3, rough, config);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::noise), 30);
}

}  // namespace
}  // namespace flagstone
