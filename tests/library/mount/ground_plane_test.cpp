// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/ground_plane.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace flagstone::mount {
namespace {

/// Points of weight 1 on a square of 8 m around the sensor, `count` along a side.
void add_level(std::vector<NearPoint>& points, float height, int count) {
  for (int row = 0; row < count; ++row) {
    for (int column = 0; column < count; ++column) {
      const auto along = [&](int i) {
        return 8 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count) - 4;
      };
      points.push_back({along(column), along(row), -height, 1});
    }
  }
}

float height_found(const std::vector<NearPoint>& points) {
  PlaneSearch search(MountLimits{}, false);
  const std::optional<GroundPlane> plane = search.find(points, 0);
  return plane ? plane->height : 0;
}

TEST(PlaneSearch, FindsALevel) {
  std::vector<NearPoint> points;
  add_level(points, 1.7f, 20);
  EXPECT_NEAR(height_found(points), 1.7f, 0.01f);
}

TEST(PlaneSearch, TakesTheLowerOfTwoLevelsUnlessItHasLessThanAThirdOfTheUpperPoints) {
  std::vector<NearPoint> points;  // below a level, a point costs as much as two in it
  add_level(points, 1, 31);       // 961 points
  std::vector<NearPoint> few = points;
  add_level(points, 2, 20);  // 1 / 2.4
  add_level(few, 2, 16);     // 1 / 3.8

  EXPECT_NEAR(height_found(points), 2, 0.01f);
  EXPECT_NEAR(height_found(few), 1, 0.01f);
}

}  // namespace
}  // namespace flagstone::mount
