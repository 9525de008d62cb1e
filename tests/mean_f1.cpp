// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "mean_f1.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::tests {

double mean_f1(const std::string& name, const MakeSegmenter& make,
               const std::vector<RealScan>& scans, const eval::Protocol& protocol) {
  double sum = 0;
  std::size_t count = 0;
  for (const RealScan& scan : scans) {
    if (!scan.is_full_density()) continue;
    io::Cloud cloud;
    std::vector<std::uint32_t> classes;
    EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
    EXPECT_TRUE(io::read_reference(scan.labels, cloud.size(), classes).ok());
    Segmentation result;
    EXPECT_TRUE(make(scan.sensor_height)->segment(cloud.view(), result).ok());
    sum += eval::compare(result.labels(), eval::truth_of(protocol, cloud.view(), classes)).f1();
    ++count;
  }
  const double mean = 100 * sum / static_cast<double>(count);
  std::printf("%s, protocol %s: mean F1 %.2f %% over %zu scans\n", name.c_str(),
              protocol.name.c_str(), mean, count);
  return mean;
}

}  // namespace flagstone::tests
