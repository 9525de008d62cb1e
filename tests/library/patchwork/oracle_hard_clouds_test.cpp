// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Compares Patchwork with the oracle on clouds that are difficult for single precision, sums in
// lanes and sorting networks: unordered clouds, many equal points, lines, steep planes, wide bins,
// large heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/patchwork_config.hpp"
#include "library/patchwork/oracle_comparison.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using oracle::compare;
using oracle::Difference;
using oracle::expect_agreement;
using tests::random_cloud;
using tests::view_of;

/// 0 <= value < 1; the same numbers everywhere.
float unit(std::mt19937& random) { return static_cast<float>(random() >> 8U) / 16777216.0f; }

/// Points at random positions around the sensor, up to `range` metres away, on z = height(x, y).
std::vector<Point> surface(std::size_t points, float range, std::uint32_t seed,
                           const std::function<float(float x, float y)>& height,
                           float roughness = 0.03f) {
  std::mt19937 random(seed);
  std::vector<Point> cloud;
  cloud.reserve(points);
  while (cloud.size() < points) {
    const float rho = 2.8f + (range - 2.9f) * unit(random);
    // A multiple of the sectors of all presets: no direction is within rounding of a boundary.
    const float theta = 6.2831853f * (std::floor(12096 * unit(random)) + 0.5f) / 12096;
    const float x = rho * std::cos(theta);
    const float y = rho * std::sin(theta);
    cloud.push_back({x, y, height(x, y) + roughness * (unit(random) - 0.5f)});
  }
  return cloud;
}

std::vector<Point> shuffled(std::vector<Point> cloud, std::uint32_t seed) {
  std::ranges::shuffle(cloud, std::mt19937(seed));
  return cloud;
}

/// The parameter is the preset.
class OracleOnHardClouds : public testing::TestWithParam<std::string_view> {
 protected:
  void expect_agreement_on(const std::string& what, const std::vector<Point>& cloud) const {
    expect_agreement("preset " + std::string(GetParam()) + ", " + what,
                     compare(view_of(cloud), config));
  }

  PatchworkConfig config = PatchworkConfig::preset(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Presets, OracleOnHardClouds,
                         testing::ValuesIn(PatchworkConfig::preset_names().begin(),
                                           PatchworkConfig::preset_names().end()),
                         [](const auto& preset) { return std::string(preset.param); });

TEST_P(OracleOnHardClouds, ShuffledRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  Difference total;
  for (const tests::RealScan& scan : scans) {
    if (scan.name == "00-000001" || scan.name == "00-000002") continue;  // much like 00-000000
    io::Cloud cloud;
    const Status status = io::read_cloud(scan.points, {}, cloud);
    ASSERT_TRUE(status.ok()) << status.message();
    config.sensor_height = scan.sensor_height;
    std::vector<Point> points;
    points.reserve(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) points.push_back(cloud.view()[i]);
    total += compare(view_of(shuffled(std::move(points), 1)), config);
  }
  expect_agreement("preset " + std::string(GetParam()) + ", shuffled real scans", total);
}

TEST_P(OracleOnHardClouds, HalfOfTheBinAtOnePosition) {
  for (const std::size_t block : {8U, 64U, 512U}) {
    std::vector<Point> cloud = random_cloud(40000, 21);
    for (std::size_t i = 1; i < cloud.size(); i += 2) cloud[i] = cloud[i / block * block];
    expect_agreement_on("every other of " + std::to_string(block) + " points equal", cloud);
    expect_agreement_on("the same shuffled", shuffled(cloud, 2));
  }
}

TEST_P(OracleOnHardClouds, TwoClusters) {
  // Two tight clusters per bin, one above the other at varying height.
  std::mt19937 random(3);
  std::vector<Point> cloud;
  for (int bin = 0; bin < 300; ++bin) {
    const float rho = 3.5f + 60 * unit(random);
    const float theta = 6.2831853f * unit(random);
    const float rise = 2 * unit(random);
    for (int i = 0; i < 80; ++i) {
      const float apart = i % 2 == 0 ? 0.0f : 1.0f;
      cloud.push_back({(rho + 0.4f * apart) * std::cos(theta) + 1e-3f * unit(random),
                       (rho + 0.4f * apart) * std::sin(theta) + 1e-3f * unit(random),
                       -1.73f + rise * apart + 1e-3f * unit(random)});
    }
  }
  expect_agreement_on("two clusters a bin", cloud);
}

TEST_P(OracleOnHardClouds, Poles) {
  // Points straight above each other can only form a vertical plane.
  std::mt19937 random(4);
  std::vector<Point> cloud;
  for (int pole = 0; pole < 200; ++pole) {
    const float rho = 3.5f + 60 * unit(random);
    const float theta = 6.2831853f * unit(random);
    for (int i = 0; i < 60; ++i) {
      cloud.push_back({rho * std::cos(theta), rho * std::sin(theta),
                       -1.73f + 0.035f * static_cast<float>(i) + 0.01f * unit(random)});
    }
  }
  expect_agreement_on("poles", cloud);
}

TEST_P(OracleOnHardClouds, PolesOnGround) {
  std::mt19937 random(5);
  std::vector<Point> cloud = random_cloud(30000, 22);
  for (std::size_t i = 0; i < 6000; ++i) {
    Point top = cloud[i / 30 * 150];
    top.z += 3 * unit(random);
    cloud.push_back(top);
  }
  expect_agreement_on("poles on ground", cloud);
}

TEST_P(OracleOnHardClouds, Staircase) {
  const auto stairs = [](float x, float) { return -1.73f + 0.16f * std::floor(x / 0.31f); };
  expect_agreement_on("stairs", surface(60000, 30, 6, stairs, 0.01f));
  const auto slabs = [](float x, float y) { return -1.73f + (std::sin(x + y) > 0 ? 0.3f : 0.0f); };
  expect_agreement_on("kerbs", surface(60000, 60, 7, slabs, 0.01f));
}

TEST_P(OracleOnHardClouds, PlanesTiltedByUpTo60Degrees) {
  for (const float degrees : {5.0f, 15.0f, 30.0f, 40.0f, 45.0f, 50.0f, 60.0f}) {
    const float slope = std::tan(degrees * 0.0174532925f);
    const auto plane = [slope](float x, float y) { return -1.73f + slope * (0.8f * x - 0.6f * y); };
    expect_agreement_on(std::to_string(static_cast<int>(degrees)) + " degrees",
                        surface(60000, 79, 8, plane, 0.5f));
  }
}

TEST_P(OracleOnHardClouds, BinsOf300Metres) {
  config.zones = {{.ring_radii = {302.7f}, .sectors = 4}};
  config.elevation.range = 400;
  const auto hills = [](float x, float y) {
    return -1.73f + 0.02f * x + 3 * std::sin(0.02f * x) * std::cos(0.03f * y);
  };
  expect_agreement_on("bins 300 m wide, hills", surface(60000, 302, 9, hills, 0.5f));
  const auto level = [](float, float) { return -1.73f; };
  expect_agreement_on("bins 300 m wide, level", surface(60000, 302, 10, level, 0.5f));
  config.zones = {{.ring_radii = {1000}, .sectors = 1}};
  expect_agreement_on("one bin of 2 km", surface(60000, 999, 11, level, 0.5f));
}

TEST_P(OracleOnHardClouds, HeightsOf9999Metres) {
  config.noise_depth = std::numeric_limits<float>::infinity();
  // With a margin, all points may be below it; the next test covers that.
  for (Zone& zone : config.zones) zone.height_margin = -std::numeric_limits<float>::infinity();
  for (const float height : {-9999.0f, 9999.0f}) {
    const auto level = [height](float x, float) { return height + 0.004f * x; };
    expect_agreement_on("ground at " + std::to_string(height) + " m",
                        surface(60000, 79, 12, level, 0.5f));
    std::vector<Point> cloud = random_cloud(40000, 23);
    for (std::size_t i = 0; i < cloud.size(); i += 50) cloud[i].z = height;
    expect_agreement_on("one point in 50 at " + std::to_string(height) + " m", cloud);
  }
}

TEST_P(OracleOnHardClouds, GroundBelowEveryMargin) {
  // Without seeds, heights are relative to the sensor, with a resolution of 8 micrometres at 100 m.
  config.noise_depth = std::numeric_limits<float>::infinity();
  const auto level = [](float x, float) { return -100 + 0.004f * x; };
  expect_agreement_on("ground at -100 m", surface(60000, 79, 14, level, 0.5f));
}

TEST_P(OracleOnHardClouds, ReflectionsAtMinus9000MetresThatAreNotNoise) {
  config.noise_depth = std::numeric_limits<float>::infinity();
  for (const std::size_t every : {2U, 5U, 20U, 100U, 1000U}) {
    std::vector<Point> cloud = random_cloud(40000, 24);
    for (std::size_t i = 0; i < cloud.size(); i += every) cloud[i].z = -9000;
    expect_agreement_on("one in " + std::to_string(every) + " at -9000 m", cloud);
  }
}

TEST_P(OracleOnHardClouds, SensorsOnTheGroundAndFarAboveIt) {
  for (const float sensor_height : {0.0f, 0.3f, 30.0f, 100.0f}) {
    config.sensor_height = sensor_height;
    std::vector<Point> cloud = random_cloud(60000, 25);
    std::mt19937 random(13);
    for (Point& p : cloud) p.z += 1.73f - sensor_height + 0.4f * unit(random);
    expect_agreement_on("sensor height " + std::to_string(sensor_height) + " m", cloud);
  }
}

}  // namespace
}  // namespace flagstone
