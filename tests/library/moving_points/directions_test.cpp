// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/directions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace flagstone {
namespace {

constexpr PixelGrid half_degree_rows{.rows_per_radian = static_cast<float>(360 / std::numbers::pi)};

PointArrays arrays_of(const std::vector<Point>& points) {
  PointArrays arrays;
  arrays.start(points.size());
  for (const Point& point : points) arrays.push_back(point);
  arrays.finish();
  return arrays;
}

TEST(Directions, AgreeWithTheArcTangentOfTheStandardLibrary) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-60, 60);
  std::vector<Point> points(5000);
  for (Point& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};

  Directions directions;
  directions.compute(arrays_of(points), identity_transform, half_degree_rows);

  int other_pixels = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto [x, y, z] = points[k];
    const double elevation = std::atan2(double{z}, std::hypot(double{x}, double{y}));
    const double azimuth = std::atan2(double{y}, double{x});
    EXPECT_NEAR(directions.elevation(k), elevation, 3e-5);
    EXPECT_NEAR(directions.range(k), std::hypot(x, y, z), 1e-4);
    const double column = (azimuth + std::numbers::pi) * 1029 / (2 * std::numbers::pi);
    EXPECT_NEAR(directions.column(k) + 0.5, column, 0.51);
    const double row = std::floor(elevation * 360 / std::numbers::pi);
    EXPECT_NEAR(directions.row(k), row, 1);
    other_pixels += directions.row(k) != static_cast<int>(row) ? 1 : 0;
  }
  EXPECT_LT(other_pixels, 50);
}

TEST(Directions, AxesAndTheOriginHavePixels) {
  const std::vector<Point> points{{10, 0, 0},  {0, 10, 0}, {-10, 0, 0}, {-10, -0.01F, 0},
                                  {0, -10, 0}, {0, 0, 10}, {0, 0, -10}, {0, 0, 0}};
  Directions directions;
  directions.compute(arrays_of(points), identity_transform, half_degree_rows);
  const std::vector<int> columns{514, 771, 1028, 0, 257};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    EXPECT_NEAR(directions.column(k), columns[k], 1) << k;
    EXPECT_NEAR(directions.row(k), 0, 1) << k;
  }
  EXPECT_NEAR(directions.row(5), 179, 1);
  EXPECT_NEAR(directions.row(6), -180, 1);
  EXPECT_EQ(directions.range(7), 0);
  EXPECT_GE(directions.column(7), 0);
}

TEST(Directions, PointsAreTransformedFirst) {
  // 90 degrees to the left, then 1 m up.
  const AffineTransform transform{0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1};
  Directions directions;
  directions.compute(arrays_of({{10, 0, 0}}), transform, half_degree_rows);
  EXPECT_NEAR(directions.column(0), 771, 1);
  EXPECT_NEAR(directions.elevation(0), std::atan2(1, 10), 3e-5);
  EXPECT_NEAR(directions.range(0), std::hypot(10, 1), 1e-4);
}

TEST(Directions, AnyPointHasAValidColumn) {
  std::vector<Point> points;
  const std::vector<float> values{0, -0.0F, 1e-40F, 1e-20F, 1, 1e18F, -1e-40F, -1e-20F, -1, -1e18F};
  for (const float x : values) {
    for (const float y : values) {
      for (const float z : values) points.push_back({x, y, z});
    }
  }
  Directions directions;
  directions.compute(arrays_of(points), identity_transform, half_degree_rows);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_GE(directions.column(k), 0);
    EXPECT_LT(directions.column(k), PixelGrid::columns);
    EXPECT_LE(std::abs(directions.row(k)), 181);
  }
}

}  // namespace
}  // namespace flagstone
