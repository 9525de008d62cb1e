// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Accuracy on real scans, per preset and protocol; the definitions are in eval/protocol.hpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/patchwork.hpp"
#include "lab/eval/confusion.hpp"
#include "lab/eval/protocol.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

/// Mean F1 over the full-density KITTI scans, percent. `name`: what the settings are called.
double mean_f1(const std::vector<tests::RealScan>& scans, const std::string& name,
               PatchworkConfig config, const eval::Protocol& protocol) {
  double sum = 0;
  std::size_t count = 0;
  for (const tests::RealScan& scan : scans) {
    if (!scan.is_full_density()) continue;
    io::Cloud cloud;
    std::vector<std::uint32_t> classes;
    EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
    EXPECT_TRUE(io::read_reference(scan.labels, cloud.size(), classes).ok());
    config.sensor_height = scan.sensor_height;
    Patchwork patchwork(config);
    Segmentation result;
    EXPECT_TRUE(patchwork.segment(cloud.view(), result).ok());
    sum += eval::compare(result.labels(), eval::truth_of(protocol, cloud.view(), classes)).f1();
    ++count;
  }
  const double mean = 100 * sum / static_cast<double>(count);
  std::printf("%s, protocol %s: mean F1 %.2f %% over %zu KITTI scans\n", name.c_str(),
              protocol.name.c_str(), mean, count);
  return mean;
}

double mean_f1(const std::vector<tests::RealScan>& scans, const std::string& preset,
               const eval::Protocol& protocol) {
  return mean_f1(scans, "preset " + preset, PatchworkConfig::preset(preset), protocol);
}

TEST(Accuracy, DefaultPresetOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(mean_f1(scans, "default", eval::patchwork_protocol()), 94.5);
  EXPECT_GE(mean_f1(scans, "default", eval::patchwork_plusplus_protocol()), 97.7);
}

TEST(Accuracy, WhatIsDerivedFromTheHdl64eIsAsGoodAsTheDefaultPresetOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);
  const PatchworkConfig derived = PatchworkConfig::for_sensor("hdl-64e");

  for (const eval::Protocol& protocol :
       {eval::patchwork_protocol(), eval::patchwork_plusplus_protocol()}) {
    EXPECT_GE(mean_f1(scans, "derived from hdl-64e", derived, protocol),
              mean_f1(scans, "default", protocol) - 0.25)
        << protocol.name;
  }
}

TEST(Accuracy, ReferencePresetIsWithinHalfAPointOfTheAuthorsPackageOnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  // pypatchworkpp 1.4.1, class patchwork, sensor height 1.73 m, on the same scans; docs/presets.md
  EXPECT_NEAR(mean_f1(scans, "reference", eval::patchwork_protocol()), 95.07, 0.5);
  EXPECT_NEAR(mean_f1(scans, "reference", eval::patchwork_plusplus_protocol()), 98.07, 0.5);
}

}  // namespace
}  // namespace flagstone
