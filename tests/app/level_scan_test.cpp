// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/level_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace flagstone::app {
namespace {

const std::vector<float> points = {10, 2, -1.5F, -3, 7, 0.5F, 0, -12, 4};
const Pose pose{.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1}, .position = {100, 200, 3}};

std::array<double, 3> in_world(const Pose& of, Point point, double scale = 1) {
  std::array<double, 3> world = of.position;
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const r = of.rotation.data() + 3 * row;
    world[row] +=
        scale * (r[0] * double{point.x} + r[1] * double{point.y} + r[2] * double{point.z});
  }
  return world;
}

TEST(LevelScan, DoesNotCopyACloudThatIsLevel) {
  LevelScan scan;
  scan.set(CloudView(points.data(), 3), {}, pose);

  EXPECT_EQ(static_cast<const void*>(scan.cloud().data()), static_cast<const void*>(points.data()));
  EXPECT_EQ(scan.pose().rotation, pose.rotation);
  EXPECT_EQ(scan.pose().position, pose.position);
}

TEST(LevelScan, KeepsThePositionsInTheWorldFrame) {
  const CloudView cloud(points.data(), 3);
  for (const Mount& mount :
       {Mount{.up = {0.3F, -0.2F, 0.9F}}, Mount{.origin = {1, 2, 1.8F}}, Mount{.scale = 0.01F},
        Mount{.up = {0, 0, -1}, .origin = {-1, 0, 2}, .scale = 2}}) {
    LevelScan scan;
    scan.set(cloud, mount, pose);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const auto expected = in_world(pose, cloud[i], double{mount.scale});
      const auto world = in_world(scan.pose(), scan.cloud()[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(world[axis], expected[axis], 1e-4);
    }
  }
}

TEST(LevelScan, HasTheUpDirectionAsZAxis) {
  const std::vector<float> above = {0.6F, 0, 0.8F};  // 1 m along the up direction
  LevelScan scan;
  scan.set(CloudView(above.data(), 1), {.up = {3, 0, 4}}, pose);

  EXPECT_NEAR(scan.cloud()[0].x, 0, 1e-6);
  EXPECT_NEAR(scan.cloud()[0].z, 1, 1e-6);
}

TEST(LevelScan, CanBeUsedForScansOfAnySize) {
  LevelScan scan;
  scan.set(CloudView(points.data(), 3), {.scale = 2}, pose);
  scan.set(CloudView(points.data(), 0), {.scale = 2}, pose);

  EXPECT_EQ(scan.cloud().size(), 0U);
}

}  // namespace
}  // namespace flagstone::app
