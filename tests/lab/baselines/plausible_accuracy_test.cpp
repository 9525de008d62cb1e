// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Every baseline does on real scans about as well as it did elsewhere.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <vector>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/confusion.hpp"
#include "lab/eval/protocol.hpp"
#include "methods.hpp"
#include "real_scans.hpp"

namespace flagstone {
namespace {

/// Points of F1, percent, that different scans may take away.
constexpr double tolerance = 4;

/// Mean F1 over the full-density KITTI scans, percent.
double mean_f1(const tests::Method& method, const std::vector<tests::RealScan>& scans,
               const eval::Protocol& protocol) {
  const auto segmenter = method.make();
  double sum = 0;
  std::size_t count = 0;
  for (const tests::RealScan& scan : scans) {
    if (!scan.is_full_density()) continue;
    io::Cloud cloud;
    std::vector<std::uint32_t> classes;
    EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
    EXPECT_TRUE(io::read_reference(scan.labels, cloud.size(), classes).ok());
    Segmentation result;
    EXPECT_TRUE(segmenter->segment(cloud.view(), result).ok());
    sum += eval::compare(result.labels(), eval::truth_of(protocol, cloud.view(), classes)).f1();
    ++count;
  }
  const double mean = 100 * sum / static_cast<double>(count);
  std::printf("%s, protocol %s: mean F1 %.1f %% over %zu KITTI scans\n", method.name.c_str(),
              protocol.name.c_str(), mean, count);
  return mean;
}

/// Tests on real scans; the parameter is the method.
class PlausibleAccuracy : public testing::TestWithParam<tests::Method> {};

INSTANTIATE_TEST_SUITE_P(All, PlausibleAccuracy, testing::ValuesIn(tests::methods()),
                         tests::name_of);

TEST_P(PlausibleAccuracy, OnKittiIsNoWorseThanMeasuredElsewhere) {
  const auto scans = tests::real_scans("kitti");
  FLAGSTONE_REQUIRE_SCANS(scans);
  const tests::Method& method = GetParam();

  EXPECT_GE(mean_f1(method, scans, eval::patchwork_protocol()), method.f1_patchwork - tolerance);
  EXPECT_GE(mean_f1(method, scans, eval::patchwork_plusplus_protocol()),
            method.f1_patchwork_plusplus - tolerance);
}

}  // namespace
}  // namespace flagstone
