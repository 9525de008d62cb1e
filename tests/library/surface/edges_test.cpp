// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Labels of the method `surface` for ground on two levels and reflections below it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "edge_scan.hpp"
#include "flagstone/surface.hpp"
#include "library/plane_fits/scan_points.hpp"
#include "library/surface/lower_ground.hpp"
#include "library/surface/square_scan.hpp"
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
  const tests::SquareScan sorted(cloud, SurfaceConfig{});
  surface::LowerGround lower_ground(sorted.cells);
  std::vector<Label> labels(cloud.size(), Label::noise);
  const std::size_t found = lower_ground.find(sorted.scan, labels);
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

TEST(LowerGround, KeepsNoStateBetweenScans) {
  const std::vector<Point> few = rows_of(11, rough);
  const tests::SquareScan sorted(few, SurfaceConfig{});
  surface::LowerGround lower_ground(sorted.cells);
  for (int scan = 0; scan < 3; ++scan) {
    std::vector<Label> labels(few.size(), Label::noise);
    EXPECT_EQ(lower_ground.find(sorted.scan, labels), 0U);
  }
}

}  // namespace
}  // namespace flagstone
