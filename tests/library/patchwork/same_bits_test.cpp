// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The promise that labels and patches do not depend on the machine: the same bytes on every
// instruction set and for every number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/patchwork.hpp"
#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/patchwork/outcome.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::random_cloud;
using tests::view_of;

/// Ring radii of `count` equal rings and the sectors of each, as one zone.
PatchworkConfig one_zone(int count, int sectors) {
  PatchworkConfig config;
  config.zones = {{.ring_radii = equal_rings(config.min_range, 80, count), .sectors = sectors}};
  return config;
}

/// The same, of a sensor that sees nothing but what is behind it.
PatchworkConfig rear_view(PatchworkConfig config) {
  config.field_of_view = {.begin = 110, .width = 140};
  return config;
}

/// A configuration and what it is called.
struct Setting {
  std::string name;
  PatchworkConfig config;
};

std::vector<Setting> presets() {
  std::vector<Setting> settings;
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    settings.push_back({std::string(name), PatchworkConfig::preset(name)});
  }
  return settings;
}

/// Layouts that take other paths than the presets'. Up to 16 rings are looked up in registers.
std::vector<Setting> unusual_layouts() {
  return {{"16 rings", one_zone(16, 32)},
          {"17 rings", one_zone(17, 32)},
          {"600 rings", one_zone(600, 2)},
          {"one ring, one sector", one_zone(1, 1)},
          {"60,000 bins", one_zone(1000, 60)},
          {"3,600 sectors", one_zone(3, 3600)},
          {"65,535 bins", one_zone(257, 255)},
          {"a rear view", rear_view(PatchworkConfig())},
          {"17 rings to the rear", rear_view(one_zone(17, 32))}};
}

std::vector<Setting> presets_and_unusual_layouts() {
  std::vector<Setting> settings = presets();
  std::ranges::copy(unusual_layouts(), std::back_inserter(settings));
  return settings;
}

std::vector<Point> shuffled(std::vector<Point> cloud, std::uint32_t seed) {
  std::ranges::shuffle(cloud, std::mt19937(seed));
  return cloud;
}

/// The parameter is the instruction set.
class SameBits : public testing::TestWithParam<std::string> {
 protected:
  /// What the best instruction set says in one thread, the one of the parameter says in 1, 2 and 7.
  static void expect_same(const Setting& setting, CloudView cloud, const std::string& what) {
    const tests::Outcome expected = tests::segmented(setting.config, cloud);
    const tests::ForcedTarget forced(GetParam());
    for (const unsigned threads : {1U, 2U, 7U}) {
      Patchwork patchwork(setting.config, threads);
      EXPECT_TRUE(tests::is_same(expected, tests::segmented(patchwork, cloud)))
          << what << ", " << setting.name << ", " << threads << " threads";
    }
  }
};

INSTANTIATE_TEST_SUITE_P(On, SameBits, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SameBits, OnRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  for (const tests::RealScan& scan : scans) {
    io::Cloud cloud;
    const Status status = io::read_cloud(scan.points, {}, cloud);
    ASSERT_TRUE(status.ok()) << status.message();
    for (Setting setting : presets()) {
      setting.config.sensor_height = scan.sensor_height;
      expect_same(setting, cloud.view(), scan.name);
    }
  }
}

TEST_P(SameBits, OnMadeUpClouds) {
  const std::vector<Point> cloud = random_cloud(20000, 1);
  for (const Setting& setting : presets_and_unusual_layouts()) {
    expect_same(setting, view_of(cloud), "made up");
  }
}

TEST_P(SameBits, OnShuffledClouds) {
  const std::vector<Point> cloud = shuffled(random_cloud(20000, 2), 1);
  for (const Setting& setting : presets_and_unusual_layouts()) {
    expect_same(setting, view_of(cloud), "shuffled");
  }
}

TEST_P(SameBits, OnCorruptedClouds) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const std::vector<Point> cloud = corrupted_cloud(12000, seed);
    for (const Setting& setting : presets_and_unusual_layouts()) {
      expect_same(setting, view_of(cloud), "corrupted");
      expect_same(setting, view_of(shuffled(cloud, seed)), "corrupted and shuffled");
    }
  }
}

TEST_P(SameBits, OnPointsThatAreAllEqual) {
  for (const std::size_t size : {3U, 16U, 100U, 9000U}) {
    const std::vector<Point> cloud(size, Point{6.1f, 2.3f, -1.7f});
    for (const Setting& setting : presets()) expect_same(setting, view_of(cloud), "all equal");
  }
}

TEST_P(SameBits, OnPointsOnALine) {
  std::vector<Point> level;
  std::vector<Point> pole;
  for (int i = 0; i < 3000; ++i) {
    const auto step = static_cast<float>(i);
    level.push_back({3 + 0.025f * step, 0.7f, -1.73f});
    pole.push_back({7, 1, -1.73f + 0.001f * step});
  }
  for (const Setting& setting : presets_and_unusual_layouts()) {
    expect_same(setting, view_of(level), "level line");
    expect_same(setting, view_of(pole), "pole");
  }
}

TEST_P(SameBits, OnCloudsOf1To70Points) {
  for (std::size_t size = 1; size <= 70; ++size) {
    // In few bins, so that some are fitted.
    std::vector<Point> cloud = random_cloud(4480, static_cast<std::uint32_t>(size));
    cloud.resize(size);
    const std::string what = std::to_string(size) + " points";
    for (const Setting& setting : presets()) expect_same(setting, view_of(cloud), what);
    expect_same({"one bin", one_zone(1, 1)}, view_of(cloud), what);
    expect_same({"default", {}}, view_of(corrupted_cloud(size, 7)), what + ", corrupted");
  }
}

TEST_P(SameBits, AtTheBordersOfWhatOneThreadReadsAtATime) {
  for (const std::size_t size : {8191U, 8192U, 8193U, 8207U, 8208U, 8209U, 16384U, 16385U}) {
    const std::vector<Point> cloud = corrupted_cloud(size, 5);
    expect_same({"default", {}}, view_of(cloud), std::to_string(size) + " points");
  }
}

TEST_P(SameBits, WhateverTheSameSegmenterSawBefore) {
  const std::vector<Point> cloud = random_cloud(9000, 3);
  const std::vector<Point> before = shuffled(corrupted_cloud(30000, 4), 2);
  const tests::Outcome expected = tests::segmented(PatchworkConfig{}, view_of(cloud));
  const tests::ForcedTarget forced(GetParam());
  Patchwork patchwork({}, 2);

  tests::segmented(patchwork, view_of(before));

  EXPECT_TRUE(tests::is_same(expected, tests::segmented(patchwork, view_of(cloud))));
}

}  // namespace
}  // namespace flagstone
