// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/grid_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "flagstone/segmentation.hpp"
#include "forced_target.hpp"
#include "library/core/random.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone {
namespace {

// Points with all labels, within 40 m, with heights of -1 to 1 m or none.
struct LabelledCloud {
  explicit LabelledCloud(std::size_t points) {
    Random random(points);
    const auto number = [&](double low, double high) {
      return static_cast<float>(random.uniform(low, high));
    };
    for (std::size_t i = 0; i < points; ++i) {
      xyz.insert(xyz.end(), {number(-40, 40), number(-40, 40), number(-3, 3)});
    }
    for (Label& label : result.start(points)) {
      label = static_cast<Label>(random.bits() % label_count);
    }
    for (float& height : result.start_heights()) {
      height = random.bits() % 10 == 0 ? std::nanf("") : number(-1, 1);
    }
  }
  [[nodiscard]] CloudView view() const { return {xyz.data(), xyz.size() / 3}; }
  [[nodiscard]] LabelledScan scan() const {
    return {.cloud = view(), .labels = result.labels(), .heights = result.heights()};
  }

  std::vector<float> xyz;
  Segmentation result;
};

constexpr PointFilter filter{
    .nonground = true, .min_height = -0.5F, .max_height = 0.7F, .reach = 35};
const WorldGrid grid{.rotation = {0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1},
                     .to_sensor = {30.3, 33.1, 0.02},
                     .slope_x = 0.01,
                     .slope_y = -0.02,
                     .per_metre = 4,
                     .per_metre_up = 16,
                     .width = 256};

struct Place {
  std::int32_t column, row, level;
  friend bool operator==(const Place&, const Place&) = default;
};
constexpr Place outside{-1, -1, 0};

// Of all points.
std::vector<Place> places(const LabelledCloud& cloud, const PointFilter& used,
                          const WorldGrid& in) {
  std::vector<Place> all(cloud.view().size(), outside);
  GridPoints points;
  for (std::size_t begin = 0; begin < all.size(); begin += GridPoints::capacity) {
    find_in_grid(cloud.scan(), used, in, begin, points);
    for (std::size_t k = 0; k < points.count; ++k) {
      all.at(static_cast<std::size_t>(points.point[k])) = {points.column[k], points.row[k],
                                                           points.level[k]};
    }
  }
  return all;
}

// In double precision.
Place expected_place(const LabelledCloud& cloud, std::size_t i) {
  const Point p = cloud.view()[i];
  const Label label = cloud.result.labels()[i];
  const float height = cloud.result.heights()[i];
  if (label != Label::ground && label != Label::nonground) return outside;
  if (!(height > filter.min_height && height < filter.max_height)) return outside;
  if (p.x * p.x + p.y * p.y >= filter.reach * filter.reach) return outside;
  const auto& r = grid.rotation;
  const double dx = r[0] * double{p.x} + r[1] * double{p.y};
  const double dy = r[3] * double{p.x} + r[4] * double{p.y};
  const double column = std::floor((grid.to_sensor[0] + dx) * grid.per_metre);
  const double row = std::floor((grid.to_sensor[1] + dy) * grid.per_metre);
  if (column < 0 || column >= 256 || row < 0 || row >= 256) return outside;
  const double up = grid.to_sensor[2] + double{p.z} - (grid.slope_x * dx + grid.slope_y * dy);
  const double level = std::floor(up * grid.per_metre_up);
  return {.column = static_cast<std::int32_t>(column),
          .row = static_cast<std::int32_t>(row),
          .level = static_cast<std::int32_t>(level)};
}

TEST(GridPoints, AreThoseThatPassTheFilterWithTheirCells) {
  for (const std::size_t size : {0U, 1U, 15U, 16U, 17U, 511U, 513U, 3000U}) {
    const LabelledCloud cloud(size);

    const std::vector<Place> found = places(cloud, filter, grid);

    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(found[i], expected_place(cloud, i)) << i;
  }
}

TEST(GridPoints, AreFoundInTheOrderOfTheScan) {
  const LabelledCloud cloud(GridPoints::capacity);
  GridPoints points;
  find_in_grid(cloud.scan(), filter, grid, 0, points);
  EXPECT_GT(points.count, 20U);
  for (std::size_t k = 1; k < points.count; ++k) EXPECT_LT(points.point[k - 1], points.point[k]);
}

TEST(GridPoints, AreTheSameOnEveryInstructionSet) {
  const LabelledCloud cloud(3000);
  const std::vector<Place> expected = places(cloud, filter, grid);

  for (const std::string& target : simd_targets()) {
    const tests::ForcedTarget forced(target);
    EXPECT_EQ(places(cloud, filter, grid), expected) << target;
  }
}

TEST(GridPoints, OnTheGroundHaveTheLevelOfTheGround) {
  LabelledCloud cloud(100);
  WorldGrid on_ground = grid;
  on_ground.on_ground = true;
  const std::vector<Place> below = places(cloud, filter, on_ground);
  for (std::size_t i = 0; i < 100; ++i) {
    cloud.xyz[3 * i + 2] -= cloud.result.heights()[i];
  }

  const std::vector<Place> moved = places(cloud, filter, grid);

  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(below[i].column, moved[i].column);
    EXPECT_LE(std::abs(below[i].level - moved[i].level), 1);  // rounded to float
  }
}

TEST(GridPoints, AreOutsideIfTheirPositionIsNotFinite) {
  LabelledCloud cloud(16);
  std::ranges::fill(cloud.result.start(16), Label::ground);
  std::ranges::fill(cloud.result.start_heights(), 0.0F);
  const float worst[] = {std::nanf(""), std::numeric_limits<float>::infinity(), -1e38F, 1e38F};
  for (std::size_t i = 0; i < 4; ++i) cloud.xyz[3 * i + 2] = worst[i];
  WorldGrid invalid = grid;
  invalid.slope_x = std::nan("");

  const std::vector<Place> found = places(cloud, filter, grid);

  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(found[i], outside) << worst[i];
  EXPECT_EQ(places(cloud, filter, invalid), std::vector<Place>(16, outside));
}

}  // namespace
}  // namespace flagstone
