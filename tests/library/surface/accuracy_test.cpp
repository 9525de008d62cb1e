// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Accuracy on real scans, per set and protocol; the definitions are in eval/protocol.hpp and, for
// sets with classes of their own, in their classes.json.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "flagstone/surface.hpp"
#include "lab/eval/confusion.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/protocol_file.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

/// Mean F1 over the full-density scans of a set, percent.
double mean_f1(const std::vector<tests::RealScan>& scans, const eval::Protocol& protocol) {
  double sum = 0;
  std::size_t count = 0;
  for (const tests::RealScan& scan : scans) {
    if (!scan.is_full_density()) continue;
    io::Cloud cloud;
    std::vector<std::uint32_t> classes;
    EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
    EXPECT_TRUE(io::read_reference(scan.labels, cloud.size(), classes).ok());
    SurfaceConfig config;
    config.sensor_height = scan.sensor_height;  // all that differs from set to set
    Surface segmenter(config);
    Segmentation result;
    EXPECT_TRUE(segmenter.segment(cloud.view(), result).ok());
    sum += eval::compare(result.labels(), eval::truth_of(protocol, cloud.view(), classes)).f1();
    ++count;
  }
  const double mean = 100 * sum / static_cast<double>(count);
  std::printf("surface, protocol %s: mean F1 %.2f %% over %zu scans\n", protocol.name.c_str(), mean,
              count);
  return mean;
}

/// The classes of a set of real scans.
eval::Protocol protocol_of(const std::string& set) {
  eval::Protocol protocol;
  const Status status =
      eval::read_protocol(tests::real_scan_folder() / set / "classes.json", protocol);
  EXPECT_TRUE(status.ok()) << status.message();
  return protocol;
}

TEST(SurfaceAccuracy, OnKitti) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(mean_f1(scans, eval::patchwork_protocol()), 96.3);
  EXPECT_GE(mean_f1(scans, eval::patchwork_plusplus_protocol()), 99.1);
}

TEST(SurfaceAccuracy, OnNuScenes) {
  const auto scans = tests::real_scans("nuscenes");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(mean_f1(scans, protocol_of("nuscenes")), 98.4);
}

TEST(SurfaceAccuracy, OnLivox) {
  const auto scans = tests::real_scans("livox");
  FLAGSTONE_REQUIRE_SCANS(scans);

  EXPECT_GE(mean_f1(scans, protocol_of("livox")), 95.8);
}

}  // namespace
}  // namespace flagstone
