// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Compares Patchwork with a direct implementation of the equations in double precision, for each
// scan and preset.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/patchwork_config.hpp"
#include "lab/sim/drive.hpp"
#include "library/patchwork/oracle_comparison.hpp"
#include "random_cloud.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

using oracle::compare;
using oracle::Difference;
using oracle::expect_agreement;

/// Removes points on the axes. Axes are sector boundaries, where the rounding of an arc tangent
/// decides the sector. concentric_zones_test covers these points.
bool lies_on_an_axis(const Point& p) { return std::abs(p.x) < 1e-30f || std::abs(p.y) < 1e-30f; }

class Oracle : public testing::TestWithParam<std::string_view> {
 protected:
  PatchworkConfig config = PatchworkConfig::preset(GetParam());
  std::string preset = std::string(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Presets, Oracle,
                         testing::ValuesIn(PatchworkConfig::preset_names().begin(),
                                           PatchworkConfig::preset_names().end()),
                         [](const auto& preset) { return std::string(preset.param); });

TEST_P(Oracle, AgreesOnRealScans) {
  const std::vector<tests::RealScan> scans = tests::real_scans();
  FLAGSTONE_REQUIRE_SCANS(scans);
  Difference total;
  for (const tests::RealScan& scan : scans) {
    io::Cloud cloud;
    const Status status = io::read_cloud(scan.points, {}, cloud);
    ASSERT_TRUE(status.ok()) << status.message();
    config.sensor_height = scan.sensor_height;
    total += compare(cloud.view(), config);
  }
  expect_agreement("preset " + preset + ", " + std::to_string(scans.size()) + " real scans", total);
}

TEST_P(Oracle, AgreesOnSimulatedScans) {
  Difference total;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const sim::SimulatedScan scan = sim::simulate_street(seed, 2);
    total += compare(CloudView(scan.xyzi.data(), scan.size(), 4), config);
  }
  expect_agreement("preset " + preset + ", 3 simulated scans", total);
}

TEST_P(Oracle, AgreesOnRandomClouds) {
  Difference total;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    total += compare(tests::view_of(tests::random_cloud(20000, seed)), config);
  }
  expect_agreement("preset " + preset + ", 10 random clouds", total);
}

TEST_P(Oracle, AgreesOnCorruptedClouds) {
  Difference total;
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    std::vector<Point> cloud = tests::corrupted_cloud(20000, seed);
    std::erase_if(cloud, lies_on_an_axis);
    total += compare(tests::view_of(cloud), config);
  }
  expect_agreement("preset " + preset + ", 10 corrupted clouds", total);
}

TEST(OracleOnSettings, AgreesOnSettingsForSensorsWithWideAndNarrowViews) {
  for (const char* name : {"hdl-64e", "vlp-16", "at128", "livox-avia"}) {
    const PatchworkConfig config = PatchworkConfig::for_sensor(name);
    Difference total;
    for (std::uint32_t seed = 0; seed < 3; ++seed) {
      total += compare(tests::view_of(tests::random_cloud(20000, seed)), config);
    }
    expect_agreement(std::string("derived from ") + name, total);
  }
}

TEST(OracleOnSettings, AgreesForEveryCombinationOfTerms) {
  const std::vector<Point> cloud = tests::random_cloud(30000, 77);
  for (int switches = 0; switches < 32; ++switches) {
    PatchworkConfig config = PatchworkConfig::preset("paper");
    config.uprightness.enabled = (switches & 1) != 0;
    config.elevation.enabled = (switches & 2) != 0;
    config.flatness.enabled = (switches & 4) != 0;
    config.evaluate_final_set = (switches & 8) != 0;
    config.keep_below_margin = (switches & 16) != 0;
    const Difference difference = compare(tests::view_of(cloud), config);
    EXPECT_LE(difference.different_labels * 10000, difference.points) << "switches " << switches;
    EXPECT_EQ(difference.different_verdicts, 0u) << "switches " << switches;
  }
}

}  // namespace
}  // namespace flagstone
