// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "mean_f1.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>

#include "files/io/cloud.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::tests {

namespace {

/// The points of a cloud, turned about z by an angle in radians.
std::vector<Point> turned(const CloudView& cloud, double angle) {
  const auto cosine = static_cast<float>(std::cos(angle));
  const auto sine = static_cast<float>(std::sin(angle));
  std::vector<Point> points(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud[i];
    points[i] = {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y, p.z};
  }
  return points;
}

}  // namespace

double mean_f1(const std::string& name, const MakeSegmenter& make,
               const std::vector<RealScan>& scans, const eval::Protocol& protocol, int turns) {
  double sum = 0;
  std::size_t count = 0;
  for (const RealScan& scan : scans) {
    if (!scan.is_full_density()) continue;
    io::Cloud cloud;
    std::vector<std::uint32_t> classes;
    EXPECT_TRUE(io::read_cloud(scan.points, {}, cloud).ok());
    EXPECT_TRUE(io::read_reference(scan.labels, cloud.size(), classes).ok());
    const auto truth = eval::truth_of(protocol, cloud.view(), classes);
    for (int turn = 0; turn < turns; ++turn) {
      const std::vector<Point> points =
          turned(cloud.view(), 2 * std::numbers::pi * turn / static_cast<double>(turns));
      Segmentation result;
      EXPECT_TRUE(make(scan.sensor_height)
                      ->segment(CloudView(std::span<const Point>(points)), result)
                      .ok());
      sum += eval::compare(result.labels(), truth).f1() / turns;
    }
    ++count;
  }
  const double mean = 100 * sum / static_cast<double>(count);
  std::printf("%s, protocol %s: mean F1 %.2f %% over %zu scans x %d turns\n", name.c_str(),
              protocol.name.c_str(), mean, count, turns);
  return mean;
}

}  // namespace flagstone::tests
