// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The promise that what `surface` says does not depend on the machine: the same bytes of labels,
// patches, heights and grids on every instruction set and for every number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/surface.hpp"
#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/outcome.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::view_of;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();

/// A configuration and what it is called.
struct Setting {
  std::string name;
  SurfaceConfig config;
};

const Setting by_default{.name = "default", .config = {}};

template <class Change>
Setting changed(const std::string& name, const Change& change) {
  Setting setting{.name = name, .config = {}};
  change(setting.config);
  return setting;
}

/// Settings that take other paths than the default ones.
std::vector<Setting> unusual_settings() {
  std::vector<Setting> settings;
  for (const int levels : {0, 1, 3}) {
    settings.push_back(changed("levels " + std::to_string(levels),
                               [&](SurfaceConfig& c) { c.refinement.levels = levels; }));
  }
  for (const float range : {8.0f, 30.0f, 104.0f, 200.0f}) {
    settings.push_back(
        changed("range " + std::to_string(range), [&](SurfaceConfig& c) { c.max_range = range; }));
  }
  settings.push_back(changed("no limits", [](SurfaceConfig& c) {
    c.acceptance = {.upright_angle = 0,
                    .max_clutter_ratio = inf,
                    .max_height = 1000,
                    .max_slope = 10,
                    .max_step = inf,
                    .max_step_per_metre = 10};
    c.refinement.max_clutter_ratio = inf;
    c.noise_depth = 1000;
    c.noise_slope = 10;
  }));
  settings.push_back(changed("high sensor", [](SurfaceConfig& c) { c.sensor_height = 100; }));
  return settings;
}

std::vector<Point> shuffled(std::vector<Point> cloud, std::uint32_t seed) {
  std::ranges::shuffle(cloud, std::mt19937(seed));
  return cloud;
}

/// The parameter is the instruction set.
class SurfaceSameBits : public testing::TestWithParam<std::string> {
 protected:
  /// What the best instruction set says in one thread, the one of the parameter says in 1, 2 and 7.
  static void expect_same(const Setting& setting, CloudView cloud, const std::string& what) {
    const tests::SurfaceOutcome expected = tests::segmented(setting.config, cloud);
    const tests::ForcedTarget forced(GetParam());
    for (const unsigned threads : {1U, 2U, 7U}) {
      Surface segmenter(setting.config, threads);
      EXPECT_TRUE(tests::is_same(expected, tests::segmented(segmenter, cloud)))
          << what << ", " << setting.name << ", " << threads << " threads";
    }
  }

  static void expect_same(const std::vector<Point>& cloud, const std::string& what) {
    expect_same(by_default, view_of(cloud), what);
  }
};

INSTANTIATE_TEST_SUITE_P(On, SurfaceSameBits, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SurfaceSameBits, OnRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  for (const tests::RealScan& scan : scans) {
    io::Cloud cloud;
    const Status status = io::read_cloud(scan.points, {}, cloud);
    ASSERT_TRUE(status.ok()) << status.message();
    const Setting setting =
        changed("h_s as is", [&](SurfaceConfig& c) { c.sensor_height = scan.sensor_height; });
    expect_same(setting, cloud.view(), scan.name);
  }
}

TEST_P(SurfaceSameBits, WithUnusualSettings) {
  const std::vector<Point> ordered = random_cloud(20000, 1);
  const std::vector<Point> corrupted = shuffled(corrupted_cloud(12000, 1), 1);
  for (const Setting& setting : unusual_settings()) {
    expect_same(setting, view_of(ordered), "made up");
    expect_same(setting, view_of(corrupted), "corrupted and shuffled");
  }
}

TEST_P(SurfaceSameBits, OnShuffledClouds) {
  expect_same(shuffled(random_cloud(30000, 2), 1), "shuffled");
}

TEST_P(SurfaceSameBits, OnCorruptedClouds) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const std::vector<Point> cloud = corrupted_cloud(12000, seed);
    expect_same(cloud, "corrupted");
    expect_same(shuffled(cloud, seed), "corrupted and shuffled");
  }
}

TEST_P(SurfaceSameBits, OnCloudsOf0To70Points) {
  expect_same({}, "no points");
  for (std::size_t size = 1; size <= 70; ++size) {
    // Of one beam's first degrees, so that they share patches.
    std::vector<Point> cloud = random_cloud(44800, static_cast<std::uint32_t>(size));
    cloud.resize(size);
    const std::string what = std::to_string(size) + " points";
    expect_same(cloud, what);
    expect_same(corrupted_cloud(size, 7), what + ", corrupted");
  }
}

TEST_P(SurfaceSameBits, AtTheBordersOfWhatOneThreadReadsAtATime) {
  for (const std::size_t size : {8191U, 8192U, 8193U, 8207U, 8208U, 8209U, 16384U, 16385U}) {
    expect_same(corrupted_cloud(size, 5), std::to_string(size) + " points");
  }
}

TEST_P(SurfaceSameBits, OnPointsThatAreAllEqual) {
  for (const std::size_t size : {3U, 16U, 17U, 100U, 9000U}) {
    expect_same(std::vector<Point>(size, Point{6.1f, 2.3f, -1.7f}), "all equal");
  }
}

TEST_P(SurfaceSameBits, OnPointsInOneCell) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> inside(0, 0.25f);
  std::vector<Point> cloud(5000);
  for (Point& p : cloud) p = {6 + inside(random), 2 + inside(random), -1.8f + inside(random)};
  for (const std::size_t size : {11U, 31U, 32U, 33U, 128U, 129U, 5000U}) {
    expect_same({cloud.begin(), cloud.begin() + static_cast<std::ptrdiff_t>(size)},
                std::to_string(size) + " points in one cell");
  }
}

TEST_P(SurfaceSameBits, OnPointsOnALine) {
  std::vector<Point> level;
  std::vector<Point> pole;
  for (int i = 0; i < 3000; ++i) {
    const auto step = static_cast<float>(i);
    level.push_back({3 + 0.025f * step, 0.7f, -1.73f});
    pole.push_back({7, 1, -1.73f + 0.001f * step});
  }
  expect_same(level, "level line");
  expect_same(pole, "pole");
}

TEST_P(SurfaceSameBits, WherePointsAreNowhere) {
  expect_same(std::vector<Point>(9000, Point{nan, 1, 1}), "not a number");
  expect_same(std::vector<Point>(9000, Point{0, -0.0f, 0}), "zeros");
  expect_same(std::vector<Point>(9000, Point{1e30f, -1e30f, 1e30f}), "far away");
  expect_same(std::vector<Point>(9000, Point{5, 5, -1e30f}), "far below");
  expect_same(std::vector<Point>(9000, Point{1e-40f, -1e-40f, 1e-42f}), "nearly at the sensor");
  expect_same(std::vector<Point>(9000, Point{10, 0, -9999}), "noise");
}

TEST_P(SurfaceSameBits, AtTheEdgeOfARangeOfWholeBlocks) {
  for (const float range : {8.0f, 16.0f, 104.0f, 200.0f}) {
    const Setting setting = changed("range", [&](SurfaceConfig& c) { c.max_range = range; });
    const float last = std::nextafter(range, 0.0f);
    std::vector<Point> cloud = random_cloud(9000, 4);
    for (int i = 0; i < 20; ++i) {
      const float z = -1 + 0.1f * static_cast<float>(i);
      for (const Point& p :
           {Point{last, 0, z}, Point{0, last, z}, Point{-last, 0, z}, Point{0, -last, z}}) {
        cloud.push_back(p);
      }
    }
    expect_same(setting, view_of(cloud), std::to_string(range));
  }
}

TEST_P(SurfaceSameBits, WithDenormalHeightsAndPlaces) {
  std::vector<Point> cloud = random_cloud(20000, 4);
  for (std::size_t i = 0; i < cloud.size(); i += 3) cloud[i].z = 1e-41f * static_cast<float>(i);
  for (std::size_t i = 1; i < cloud.size(); i += 5) cloud[i].y = -1e-44f;
  expect_same(cloud, "denormal");
}

TEST_P(SurfaceSameBits, WhateverWasSegmentedBefore) {
  const std::vector<Point> cloud = random_cloud(9000, 8);
  const tests::SurfaceOutcome expected = tests::segmented(SurfaceConfig{}, view_of(cloud));
  const tests::ForcedTarget forced(GetParam());
  Surface segmenter({}, 2);

  for (const auto& before : {corrupted_cloud(30000, 9), shuffled(random_cloud(20000, 3), 1),
                             std::vector<Point>(), std::vector<Point>(40, Point{6, 2, -1.7f})}) {
    tests::segmented(segmenter, view_of(before));

    EXPECT_TRUE(tests::is_same(expected, tests::segmented(segmenter, view_of(cloud))));
  }
}

}  // namespace
}  // namespace flagstone
