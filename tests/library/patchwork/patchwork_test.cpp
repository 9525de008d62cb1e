// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Properties of Patchwork described in the paper, on small scenes with a known answer.
#include "flagstone/patchwork.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "outcome.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// Points on z = height(x, y), 5 cm apart, in a square of the size of a bin at (x, y).
template <class Height>
void add_square(std::vector<Point>& cloud, float x, float y, Height height) {
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const float px = x + 0.05f * static_cast<float>(i);
      const float py = y + 0.05f * static_cast<float>(j);
      cloud.push_back({px, py, height(px, py)});
    }
  }
}

/// A roughness of a few millimetres, so that planes are not exact.
float rough(float x, float y) { return 0.004f * std::sin(91 * x + 57 * y); }

tests::Outcome segment(const std::vector<Point>& cloud, const PatchworkConfig& config = {}) {
  return tests::segmented(config, tests::view_of(cloud));
}

class OnEveryPreset : public testing::TestWithParam<std::string_view> {
 protected:
  PatchworkConfig config = PatchworkConfig::preset(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Presets, OnEveryPreset,
                         testing::ValuesIn(PatchworkConfig::preset_names().begin(),
                                           PatchworkConfig::preset_names().end()),
                         [](const auto& preset) { return std::string(preset.param); });

TEST_P(OnEveryPreset, LevelGroundIsGround) {
  std::vector<Point> cloud;
  add_square(cloud, 6.45f, 0.3f, [](float x, float y) { return -1.73f + rough(x, y); });

  const tests::Outcome outcome = segment(cloud, config);

  EXPECT_EQ(std::ranges::count(outcome.labels, Label::ground), 400);
}

TEST_P(OnEveryPreset, APatchHasItsPlane) {
  std::vector<Point> cloud;
  add_square(cloud, 6.45f, 0.3f, [](float x, float y) { return -2.4f + 0.1f * x + rough(x, y); });

  const tests::Outcome outcome = segment(cloud, config);

  ASSERT_EQ(outcome.patches.size(), 1u);
  const Patch& patch = outcome.patches[0];
  EXPECT_EQ(patch.verdict, Verdict::ground);
  EXPECT_EQ(patch.point_count, 400u);
  EXPECT_EQ(patch.ground_count, 400u);
  EXPECT_NEAR(patch.normal[0], -0.1 / std::hypot(1, 0.1), 2e-3);
  EXPECT_NEAR(patch.normal[2], 1 / std::hypot(1, 0.1), 2e-3);
  EXPECT_NEAR(patch.mean[0], 6.925, 1e-3);
  EXPECT_NEAR(patch.normal[0] * 7.0f + patch.normal[1] * 1.0f + patch.normal[2] * -1.7f + patch.d,
              0, 5e-3);
  EXPECT_GE(patch.eigenvalues[0], patch.eigenvalues[1]);
  EXPECT_GE(patch.eigenvalues[1], patch.eigenvalues[2]);
  EXPECT_LT(patch.surface_variable, 1e-3);
}

TEST_P(OnEveryPreset, AWallIsNotUpright) {
  std::vector<Point> cloud;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      cloud.push_back({7 + 0.004f * std::sin(static_cast<float>(31 * i + 17 * j)),
                       0.6f + 0.03f * static_cast<float>(i),
                       -1.2f + 0.015f * static_cast<float>(j)});
    }
  }

  const tests::Outcome outcome = segment(cloud, config);

  ASSERT_EQ(outcome.patches.size(), 1u);
  EXPECT_EQ(outcome.patches[0].verdict, Verdict::not_upright);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::ground), 0);
}

TEST_P(OnEveryPreset, ACarRoofNearTheSensorIsTooHigh) {
  std::vector<Point> cloud;
  add_square(cloud, 6.45f, 0.3f, [](float x, float y) { return -0.2f + 8 * rough(x, y); });

  const tests::Outcome outcome = segment(cloud, config);

  ASSERT_EQ(outcome.patches.size(), 1u);
  EXPECT_EQ(outcome.patches[0].verdict, Verdict::too_high);
}

TEST_P(OnEveryPreset, ObjectsOnTheGroundAreNotGround) {
  std::vector<Point> cloud;
  add_square(cloud, 6.45f, 0.3f, [](float x, float y) { return -1.73f + rough(x, y); });
  for (int i = 0; i < 40; ++i) cloud.push_back({7.0f, 0.8f, -1.4f + 0.04f * static_cast<float>(i)});

  const tests::Outcome outcome = segment(cloud, config);

  for (std::size_t i = 0; i < 400; ++i) ASSERT_EQ(outcome.labels[i], Label::ground);
  for (std::size_t i = 400; i < 440; ++i) ASSERT_EQ(outcome.labels[i], Label::nonground);
}

/// Fig. 4 of the paper: level ground in the central zone, and reflections below it.
std::vector<Point> ground_with_reflections(int reflections) {
  std::vector<Point> cloud;
  add_square(cloud, 5, 0.6f, [](float x, float y) { return -1.73f + rough(x, y); });
  for (int i = 0; i < reflections; ++i) {
    const auto step = static_cast<float>(i);
    cloud.push_back({5.0f + 0.03f * step, 0.8f, -3.2f + 0.001f * step});
  }
  return cloud;
}

auto ground_found(const tests::Outcome& outcome) {
  return std::count(outcome.labels.begin(), outcome.labels.begin() + 400, Label::ground);
}

TEST_P(OnEveryPreset, AFewReflectionsDoNotChangeTheGround) {
  EXPECT_EQ(ground_found(segment(ground_with_reflections(5), config)), 400);
}

TEST(Reflections, BelowAPatchOfGroundAreNoise) {
  const tests::Outcome outcome = segment(ground_with_reflections(8));

  EXPECT_EQ(ground_found(outcome), 400);
  EXPECT_EQ(std::ranges::count(outcome.labels, Label::noise), 8);
}

TEST(AdaptiveSeeds, SkipReflectionsEvenIfThereAreMoreThanSeeds) {
  // As seeds, 25 of them would keep the first ground set at their level.
  PatchworkConfig config = PatchworkConfig::preset("paper");
  config.iterations = 1;
  config.evaluate_final_set = false;
  const std::vector<Point> cloud = ground_with_reflections(25);
  EXPECT_EQ(ground_found(segment(cloud, config)), 400);

  config.zones[0].height_margin = -std::numeric_limits<float>::infinity();

  EXPECT_EQ(ground_found(segment(cloud, config)), 0);
}

TEST(AdaptiveSeeds, KeepDistantGroundThatSlopesDown) {
  // 20 % down: -1.73 - 0.2 * 30 m, far below M_h * h_s of the central zone.
  std::vector<Point> cloud;
  const PatchworkConfig config = PatchworkConfig::preset("paper");
  add_square(cloud, 30, 0.6f, [](float x, float y) { return -1.73f - 0.2f * x + rough(x, y); });

  const tests::Outcome outcome = segment(cloud, config);

  EXPECT_EQ(std::ranges::count(outcome.labels, Label::ground), 400);
}

TEST(AdaptiveSeeds, WithoutAMarginSkipNoPointForAnySensorHeight) {
  // Ground with a slope of 10 %, at a distance where the margin is minus infinity. It is 3 m above
  // height 0, the seed height of a bin without candidates.
  std::vector<Point> cloud;
  for (const float sensor_height : {1.73f, 0.0f, -1.0f}) {
    PatchworkConfig config;
    config.sensor_height = sensor_height;
    ASSERT_TRUE(std::isinf(config.zones[2].height_margin));
    cloud.clear();
    add_square(cloud, 30, 0.6f,
               [=](float x, float y) { return 0.1f * x - sensor_height + rough(x, y); });

    const tests::Outcome outcome = segment(cloud, config);

    EXPECT_EQ(std::ranges::count(outcome.labels, Label::ground), 400) << sensor_height;
  }
}

TEST(FewPoints, GetTheConfiguredLabel) {
  const std::vector<Point> cloud = {{7, 1, -1.7f}, {7.1f, 1, -1.7f}, {7, 1.1f, -1.7f}};
  PatchworkConfig config;
  config.sparse_bins_are_ground = true;
  EXPECT_EQ(segment(cloud, config).labels, std::vector(3, Label::ground));

  config.sparse_bins_are_ground = false;
  const tests::Outcome outcome = segment(cloud, config);

  EXPECT_EQ(outcome.labels, std::vector(3, Label::nonground));
  EXPECT_EQ(outcome.patches[0].verdict, Verdict::too_few_points);
}

TEST(Iterations, MorePlanesFitCloser) {
  // A step in the bin: the first set contains both levels, and the plane converges to the lower
  // one.
  std::vector<Point> cloud;
  add_square(cloud, 6.45f, 0.3f, [](float x, float y) { return -1.73f + rough(x, y); });
  for (int i = 0; i < 60; ++i)
    cloud.push_back({6.45f + 0.01f * static_cast<float>(i), 1.2f, -1.35f});
  PatchworkConfig config;
  config.iterations = 1;
  const float first = segment(cloud, config).patches[0].surface_variable;

  config.iterations = 3;
  const float third = segment(cloud, config).patches[0].surface_variable;

  EXPECT_LT(third, 0.5f * first);
}

TEST(Patches, AreOrderedByZoneRingAndSector) {
  const std::vector<Patch> patches = segment(tests::random_cloud(60000, 2)).patches;

  EXPECT_TRUE(std::ranges::is_sorted(patches, [](const Patch& a, const Patch& b) {
    return std::tie(a.zone, a.ring, a.sector) < std::tie(b.zone, b.ring, b.sector);
  }));
  EXPECT_GT(patches.size(), 100u);
}

TEST(Zones, OneZoneOfEqualRingsIsAUniformPolarGrid) {
  PatchworkConfig config;
  config.zones = {
      {.ring_radii = equal_rings(config.min_range, 80, 30), .sectors = 108}};  // R-GPF's 3,240 bins

  const tests::Outcome outcome = segment(tests::random_cloud(60000, 2), config);

  EXPECT_GT(std::ranges::count(outcome.labels, Label::ground), 30000);
}

}  // namespace
}  // namespace flagstone
