// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Results do not depend on the machine: they are bit-identical on every instruction set and for
// every number of threads.
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <type_traits>
#include <variant>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "forced_target.hpp"
#include "library/methods/methods.hpp"
#include "numbers.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"
#ifdef FLAGSTONE_HAS_SIMULATOR
#include "lab/sim/drive.hpp"
#endif

namespace flagstone {
namespace {

using tests::corrupted_cloud;
using tests::Outcome;
using tests::random_cloud;
using tests::shuffled;
using tests::view_of;

/// Settings of one of the methods, with a name.
struct Setting {
  std::string name;
  std::variant<PatchworkConfig, SurfaceConfig> config;

  [[nodiscard]] std::unique_ptr<Segmenter> make(unsigned threads) const {
    return std::visit(
        [&](const auto& of) -> std::unique_ptr<Segmenter> {
          using Config = std::decay_t<decltype(of)>;
          using Method =
              std::conditional_t<std::is_same_v<Config, PatchworkConfig>, Patchwork, Surface>;
          return std::make_unique<Method>(of, threads);
        },
        config);
  }
};

/// One zone with `count` equal rings.
PatchworkConfig one_zone(int count, int sectors) {
  PatchworkConfig config;
  config.zones = {{.ring_radii = equal_rings(config.min_range, 80, count), .sectors = sectors}};
  return config;
}

/// One zone for a sensor that sees only the area behind it.
PatchworkConfig rear_view(PatchworkConfig config) {
  config.field_of_view = {.begin = 110, .width = 140};
  return config;
}

std::vector<Setting> patchwork_presets() {
  std::vector<Setting> settings;
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    settings.push_back({std::string(name), PatchworkConfig::preset(name)});
  }
  return settings;
}

/// Zones that take different code paths than the presets. Up to 16 rings are looked up in
/// registers.
std::vector<Setting> unusual_patchwork() {
  return {{"one ring, one sector", one_zone(1, 1)},
          {"16 rings", one_zone(16, 32)},
          {"17 rings", one_zone(17, 32)},
          {"600 rings", one_zone(600, 2)},
          {"60,000 bins", one_zone(1000, 60)},
          {"3,600 sectors", one_zone(3, 3600)},
          {"65,535 bins", one_zone(257, 255)},
          {"a rear view", rear_view(PatchworkConfig())},
          {"17 rings to the rear", rear_view(one_zone(17, 32))}};
}

template <class Change>
Setting changed(const std::string& name, const Change& change) {
  SurfaceConfig config;
  change(config);
  return {name, config};
}

/// Settings that take different code paths than the defaults.
std::vector<Setting> unusual_surface() {
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

class SameBits : public testing::TestWithParam<tests::MethodOnTarget> {
 protected:
  /// Expects the same result from the best instruction set in one thread and from the instruction
  /// set of the parameter in 1, 2 and 7 threads.
  static void expect_same(const Setting& setting, CloudView cloud, const std::string& what) {
    const Outcome expected = tests::segmented(*setting.make(1), cloud);
    const tests::ForcedTarget forced(std::get<1>(GetParam()));
    for (const unsigned threads : {1U, 2U, 7U}) {
      EXPECT_TRUE(tests::is_same(expected, tests::segmented(*setting.make(threads), cloud)))
          << what << ", " << setting.name << ", " << threads << " threads";
    }
  }
  static void expect_same(const std::vector<Setting>& settings, const std::vector<Point>& cloud,
                          const std::string& what) {
    for (const Setting& setting : settings) expect_same(setting, view_of(cloud), what);
  }

  const bool is_surface = std::get<0>(GetParam()) == "Surface";
  const Setting by_default =
      is_surface ? Setting{"default", SurfaceConfig()} : Setting{"default", PatchworkConfig()};
  const std::vector<Setting> presets = is_surface ? std::vector{by_default} : patchwork_presets();
  const std::vector<Setting> unusual = is_surface ? unusual_surface() : unusual_patchwork();
  const std::vector<Setting> all = [this] {
    std::vector<Setting> settings = presets;
    std::ranges::copy(unusual, std::back_inserter(settings));
    return settings;
  }();
};

INSTANTIATE_TEST_SUITE_P(On, SameBits, tests::methods_on_targets(), tests::name_of);

TEST_P(SameBits, OnRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  for (const tests::RealScan& scan : scans) {
    io::Cloud cloud;
    const Status status = io::read_cloud(scan.points, {}, cloud);
    ASSERT_TRUE(status.ok()) << status.message();
    for (Setting setting : presets) {
      std::visit([&](auto& config) { config.sensor_height = scan.sensor_height; }, setting.config);
      expect_same(setting, cloud.view(), scan.name);
    }
  }
}

#ifdef FLAGSTONE_HAS_SIMULATOR
TEST_P(SameBits, OnASimulatedScan) {
  const sim::SimulatedScan scan = sim::simulate_street(4, 2);
  const CloudView cloud(scan.xyzi.data(), scan.size(), 4);
  for (const Setting& setting : presets) expect_same(setting, cloud, "simulated street");
}
#endif

TEST_P(SameBits, OnRandomClouds) { expect_same(all, random_cloud(20000, 1), "made up"); }

TEST_P(SameBits, OnShuffledClouds) {
  expect_same(all, shuffled(random_cloud(20000, 2), 1), "shuffled");
}

TEST_P(SameBits, OnCorruptedClouds) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const std::vector<Point> cloud = corrupted_cloud(12000, seed);
    expect_same(all, cloud, "corrupted");
    expect_same(all, shuffled(cloud, seed), "corrupted and shuffled");
  }
}

TEST_P(SameBits, OnEqualPoints) {
  for (const std::size_t size : {3U, 16U, 17U, 100U, 9000U}) {
    expect_same(presets, std::vector<Point>(size, Point{6.1f, 2.3f, -1.7f}), "all equal");
  }
}

TEST_P(SameBits, OnPointsInOneCell) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> inside(0, 0.25f);
  std::vector<Point> cloud(5000);
  for (Point& p : cloud) p = {6 + inside(random), 2 + inside(random), -1.8f + inside(random)};
  for (const std::size_t size : {11U, 31U, 32U, 33U, 128U, 129U, 5000U}) {
    expect_same(presets, {cloud.begin(), cloud.begin() + static_cast<std::ptrdiff_t>(size)},
                std::to_string(size) + " points in one cell");
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
  expect_same(all, level, "level line");
  expect_same(all, pole, "pole");
}

TEST_P(SameBits, OnCloudsOf0To70Points) {
  std::vector<Setting> settings = presets;
  settings.push_back(unusual.front());  // Patchwork with all points in one bin
  expect_same(settings, {}, "no points");
  for (std::size_t size = 1; size <= 70; ++size) {
    const std::string what = std::to_string(size) + " points";
    // The first degrees of each beam: points in common bins and patches, so that some are fitted.
    for (const std::size_t whole : {4480U, 44800U}) {
      std::vector<Point> cloud = random_cloud(whole, static_cast<std::uint32_t>(size));
      cloud.resize(size);
      expect_same(settings, cloud, what);
    }
    expect_same({by_default}, corrupted_cloud(size, 7), what + ", corrupted");
  }
}

TEST_P(SameBits, AtChunkBoundaries) {
  for (const std::size_t size : {8191U, 8192U, 8193U, 8207U, 8208U, 8209U, 16384U, 16385U}) {
    expect_same({by_default}, corrupted_cloud(size, 5), std::to_string(size) + " points");
  }
}

TEST_P(SameBits, WithNonFiniteCoordinates) {
  const auto expect_same_of = [&](Point point, const std::string& what) {
    expect_same({by_default}, std::vector<Point>(9000, point), what);
  };
  expect_same_of({nan, 1, 1}, "not a number");
  expect_same_of({0, -0.0f, 0}, "zeros");
  expect_same_of({1e30f, -1e30f, 1e30f}, "far away");
  expect_same_of({5, 5, -1e30f}, "far below");
  expect_same_of({1e-40f, -1e-40f, 1e-42f}, "nearly at the sensor");
  expect_same_of({10, 0, -9999}, "noise");
}

TEST_P(SameBits, WithDenormalCoordinates) {
  std::vector<Point> cloud = random_cloud(20000, 4);
  for (std::size_t i = 0; i < cloud.size(); i += 3) cloud[i].z = 1e-41f * static_cast<float>(i);
  for (std::size_t i = 1; i < cloud.size(); i += 5) cloud[i].y = -1e-44f;
  expect_same({by_default}, cloud, "denormal");
}

/// Tests of settings that Patchwork does not have.
class SurfaceSameBits : public SameBits {};

INSTANTIATE_TEST_SUITE_P(On, SurfaceSameBits,
                         testing::Combine(testing::Values("Surface"),
                                          testing::ValuesIn(simd_targets())),
                         tests::name_of);

TEST_P(SurfaceSameBits, AtAMaximumRangeOfWholeBlocks) {
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
    expect_same({setting}, cloud, std::to_string(range));
  }
}

TEST_P(SameBits, WhateverWasSegmentedPreviously) {
  const std::vector<Point> cloud = random_cloud(9000, 8);
  const Outcome expected = tests::segmented(*by_default.make(1), view_of(cloud));
  const tests::ForcedTarget forced(std::get<1>(GetParam()));
  const std::unique_ptr<Segmenter> segmenter = by_default.make(2);

  for (const auto& before :
       {shuffled(corrupted_cloud(30000, 9), 2), shuffled(random_cloud(20000, 3), 1),
        std::vector<Point>(), std::vector<Point>(40, Point{6, 2, -1.7f})}) {
    tests::segmented(*segmenter, view_of(before));

    EXPECT_TRUE(tests::is_same(expected, tests::segmented(*segmenter, view_of(cloud))));
  }
}

}  // namespace
}  // namespace flagstone
