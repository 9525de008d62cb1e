// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Labels of the method `surface` for ground on two levels and reflections below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "edge_scan.hpp"
#include "flagstone/surface.hpp"
#include "library/surface/lower_ground.hpp"
#include "library/surface/square_cells.hpp"
#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

using tests::Outcome;
using tests::share_of;
using tests::view_of;

bool is_level(const Point& p) { return p.y < 5; }
bool is_behind(const Point& p) { return p.y > 5.1f; }

TEST(SurfaceAtEdges, BothSidesOfKerbsAndDropsAreGround) {
  for (const float rise : {0.15f, -0.6f, -1.0f, -1.5f, -2.0f, -3.0f}) {
    const std::vector<Point> cloud = tests::edge_scan(tests::step_of(rise));
    const Outcome outcome = tests::segmented(SurfaceConfig{}, view_of(cloud));
    EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_level), 0.97) << rise;
    EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_behind), 0.97) << rise;
  }
}

TEST(SurfaceAtEdges, TheBottomOfADitchIsGround) {
  for (const auto& [depth, share] : {std::pair(0.6f, 0.99), std::pair(1.0f, 0.8)}) {
    const std::vector<Point> cloud = tests::edge_scan(tests::ditch_of(depth));
    const Outcome outcome = tests::segmented(SurfaceConfig{}, view_of(cloud));
    const float above_bottom = -1.72f - depth;
    const auto is_bottom = [=](const Point& p) { return p.z < above_bottom; };
    EXPECT_GT(share_of(Label::ground, cloud, outcome.labels, is_bottom), share) << depth;
  }
}

TEST(SurfaceAtEdges, IsolatedGhostPointsAreNoise) {
  std::vector<Point> cloud = tests::edge_scan(tests::step_of(0));
  const std::size_t first_ghost = cloud.size();
  tests::add_ghosts(cloud, 150);
  const Outcome outcome = tests::segmented(SurfaceConfig{}, view_of(cloud));
  std::size_t noise = 0;
  for (std::size_t i = first_ghost; i < cloud.size(); ++i) {
    noise += static_cast<std::size_t>(outcome.labels[i] == Label::noise);
  }
  EXPECT_GE(noise, 147U);
}

/// Labels of points after the search for lower ground, if all points were noise before.
std::vector<Label> searched(const std::vector<Point>& cloud) {
  const surface::SquareCells cells{SurfaceConfig{}};
  surface::LowerGround lower_ground(cells);
  std::vector<Label> labels(cloud.size(), Label::noise);
  const std::size_t found = lower_ground.find(view_of(cloud), labels);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(labels, Label::ground)), found);
  return labels;
}

/// `count` points in three rows 3 m below the sensor, each shifted by `off_level`, metres.
template <class OffLevel>
std::vector<Point> rows_of(int count, const OffLevel& off_level) {
  std::vector<Point> cloud;
  for (int i = 0; i < count; ++i) {
    const int column = i / 3;
    cloud.push_back({8.5f + 0.1f * static_cast<float>(column), 9 + 0.5f * static_cast<float>(i % 3),
                     -3 + off_level(static_cast<float>(i))});
  }
  return cloud;
}

float rough(float i) { return 0.01f * std::sin(37 * i); }

TEST(LowerGround, IsFoundInASeparatePlane) {
  EXPECT_EQ(std::ranges::count(searched(rows_of(60, rough)), Label::ground), 60);
}

TEST(LowerGround, ExcludesGhostPointsAroundThePlane) {
  std::vector<Point> cloud = rows_of(60, rough);
  for (int i = 0; i < 4; ++i) cloud.push_back({9.1f, 9.2f, -3.5f - 0.2f * static_cast<float>(i)});
  const std::vector<Label> labels = searched(cloud);
  EXPECT_EQ(std::ranges::count(labels, Label::ground), 60);
  EXPECT_EQ(std::count(labels.end() - 4, labels.end(), Label::noise), 4);
}

TEST(LowerGround, IsNotFoundInIrregularOrFewPoints) {
  const auto irregular = [](float i) { return 0.7f * std::sin(37 * i); };
  EXPECT_EQ(std::ranges::count(searched(rows_of(60, irregular)), Label::ground), 0);
  EXPECT_EQ(std::ranges::count(searched(rows_of(11, rough)), Label::ground), 0);
}

TEST(LowerGround, IsNotFoundBelowTheNoiseLimit) {
  const auto too_low = [](float i) { return -10 + rough(i); };
  EXPECT_EQ(std::ranges::count(searched(rows_of(60, too_low)), Label::ground), 0);
}

TEST(LowerGround, DoesNotDependOnTheOrderOfThePoints) {
  // Many squares with rows of points that are more or less irregular, and points on their edges.
  std::mt19937 random(1);
  std::uniform_real_distribution<float> position(-40, 40);
  std::normal_distribution<float> normal;
  std::vector<Point> cloud;
  for (int square = 0; square < 60; ++square) {
    const float roughness = 0.01f * static_cast<float>(square % 10);
    const Point corner = {std::round(position(random)), std::round(position(random)), -3};
    for (int i = 0; i < 40; ++i) {
      const auto step = static_cast<float>(i);
      cloud.push_back({corner.x + 0.1f * step, corner.y + 0.5f * static_cast<float>(i % 7),
                       corner.z + 0.02f * step + roughness * normal(random)});
    }
  }
  const std::vector<Label> expected = searched(cloud);
  const auto found = std::ranges::count(expected, Label::ground);
  ASSERT_GT(found, 400);
  ASSERT_LT(found, static_cast<std::ptrdiff_t>(cloud.size()) - 400);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (int repeat = 0; repeat < 20; ++repeat) {
    std::ranges::shuffle(order, random);
    std::vector<Point> shuffled;
    for (const std::size_t i : order) shuffled.push_back(cloud[i]);

    const std::vector<Label> labels = searched(shuffled);

    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(labels[i], expected[order[i]]);
  }
}

TEST(LowerGround, KeepsNoStateBetweenScans) {
  const std::vector<Point> few = rows_of(11, rough);
  const surface::SquareCells cells{SurfaceConfig{}};
  surface::LowerGround lower_ground(cells);
  for (int scan = 0; scan < 3; ++scan) {
    std::vector<Label> labels(few.size(), Label::noise);
    EXPECT_EQ(lower_ground.find(view_of(few), labels), 0U);
  }
}

}  // namespace
}  // namespace flagstone
