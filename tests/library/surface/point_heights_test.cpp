// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/point_heights.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "flagstone/ground_surface.hpp"
#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/plane_fits/scan_runs.hpp"
#include "library/surface/square_scan.hpp"
#include "numbers.hpp"
#include "random_surface.hpp"

namespace flagstone::surface {
namespace {

/// The grids of a synthetic surface, contiguous in memory.
class JoinedGrids {
 public:
  explicit JoinedGrids(const GroundSurface& made) {
    for (const GroundSurface::Grid& grid : made.grids()) {
      heights_.insert(heights_.end(), grid.heights.begin(), grid.heights.end());
    }
    // Values that can be read after the heights, but must not be used: a row and two more.
    heights_.insert(heights_.end(), made.grids().back().width + 2, 1e9f);
    std::size_t first = 0;
    for (const GroundSurface::Grid& grid : made.grids()) {
      grids_.push_back({.cell = grid.cell,
                        .width = grid.width,
                        .heights = heights_.data() + first,
                        .confidences = nullptr});
      first += grid.heights.size();
    }
  }

  [[nodiscard]] std::span<const Grid> grids() const { return grids_; }

 private:
  std::vector<float> heights_;
  std::vector<Grid> grids_;
};

/// Grids up to 104 m from the sensor, as large as the extent of the cells for the default range.
const std::vector<tests::GridSize> wide_grids = {{.cell = 2, .width = 104},
                                                 {.cell = 1, .width = 80},
                                                 {.cell = 0.5f, .width = 96},
                                                 {.cell = 0.25f, .width = 64}};

/// Heights and labels of points above a surface.
struct Measured {
  std::vector<float> heights;
  std::vector<Label> labels;
  LabelTotals totals{};
};

/// The parameter is the instruction set.
class PointHeightsOn : public testing::TestWithParam<std::string> {
 protected:
  Measured measured(const std::vector<Point>& cloud, const GroundSurface& made,
                    const SurfaceConfig& config = {}) {
    const tests::SquareScan sorted(cloud, config);
    const JoinedGrids joined(made);
    PointHeights point_heights(config, sorted.cells, joined.grids());
    point_heights.reserve(cloud.size());
    Measured out;
    out.heights.resize(cloud.size());
    out.labels.resize(cloud.size());
    const PointHeights::Results results{.heights = out.heights, .labels = out.labels};
    const std::size_t chunks = plane_fits::chunk_count(cloud.size());
    point_heights.set_surface(joined.grids());
    for (std::size_t i = 0; i < chunks; ++i) {
      point_heights.measure(tests::view_of(cloud), sorted.points.unusual(), i, results, out.totals);
    }
    for (std::size_t i = 0; i < chunks; ++i) point_heights.label(i, results, out.totals);
    return out;
  }

  /// The label of one point above level ground at z = -2, in a cloud with `others`.
  Label label_of(const Point& point, std::vector<Point> others = {},
                 const SurfaceConfig& config = {}) {
    others.push_back(point);
    return measured(others, level_, config).labels.back();
  }

  const GroundSurface level_ =
      tests::random_surface([](float, float) { return -2.0f; }, wide_grids);

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, PointHeightsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(PointHeightsOn, AreBitIdenticalToTheSurface) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> rough(-2.5f, -1.5f);
  const GroundSurface made = tests::random_surface(
      [&](float, float) { return random() % 8 == 0 ? nan : rough(random); }, wide_grids);
  std::vector<Point> cloud;
  std::uniform_real_distribution<float> position(-100, 100);
  for (int i = 0; i < 20000; ++i) {
    // Anywhere, near the sensor, and on edges of cells and grids.
    const float scale = i % 3 == 0 ? 0.1f : 1.0f;
    Point p{scale * position(random), scale * position(random), rough(random)};
    if (i % 5 == 0) p.x = std::round(8 * p.x) / 8;
    if (i % 7 == 0) p.y = std::round(p.y);
    cloud.push_back(p);
  }

  const Measured found = measured(cloud, made);

  std::size_t known = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud[i];
    if (std::hypot(p.x, p.y) >= 100) continue;
    const float ground = made.height(p.x, p.y);
    ASSERT_EQ(std::isnan(found.heights[i]), std::isnan(ground)) << p.x << ", " << p.y;
    if (std::isnan(ground)) continue;
    ASSERT_EQ(found.heights[i], p.z - ground) << p.x << ", " << p.y;
    ++known;
  }
  EXPECT_GT(known, 5000U);
}

TEST_P(PointHeightsOn, AreNanForInvalidAndOutOfRangePoints) {
  const Measured found =
      measured({{nan, 0, 0}, {0, 0, 0}, {150, 0, 0}, {5, 5, 20000}, {5, 5, -2}}, level_);

  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isnan(found.heights[i])) << i;
  EXPECT_EQ(found.labels, (std::vector{Label::invalid, Label::invalid, Label::out_of_range,
                                       Label::out_of_range, Label::ground}));
}

TEST_P(PointHeightsOn, PointsBelowTheMarginAreGround) {
  const float margin = PointRule{}.margin;

  EXPECT_EQ(label_of({10, 0, -2 + margin - 0.001f}), Label::ground);
  EXPECT_EQ(label_of({10, 0, -2 + margin + 0.001f}), Label::nonground);
  EXPECT_EQ(label_of({10, 0, -2 - 0.3f}), Label::ground);
}

// 10 m from the sensor, the surface has cells of 0.5 m. Its squares lie between their centres, for
// example from 10.25 to 10.75 m.

TEST_P(PointHeightsOn, TheMarginIsSmallerInSquaresWithAnObstacle) {
  const PointRule rule;
  const float margin = rule.obstacle_margin;
  const std::vector<Point> pole = {{10.3f, 0.3f, -2 + 1.25f * rule.obstacle_height + 0.01f}};

  EXPECT_EQ(label_of({10.7f, 0.7f, -2 + margin - 0.001f}, pole), Label::ground);
  EXPECT_EQ(label_of({10.7f, 0.7f, -2 + margin + 0.001f}, pole), Label::nonground);
  EXPECT_EQ(label_of({10.8f, 0.7f, -2 + margin + 0.001f}, pole), Label::ground) << "next square";
}

TEST_P(PointHeightsOn, TheMeanMarginAppliesInSquaresWithALowObstacle) {
  const PointRule rule;
  const float margin = (rule.margin + rule.obstacle_margin) / 2;
  for (const float height :
       {0.75f * rule.obstacle_height + 0.01f, 1.25f * rule.obstacle_height - 0.01f}) {
    const std::vector<Point> stone = {{10.3f, 0.3f, -2 + height}};

    EXPECT_EQ(label_of({10.7f, 0.7f, -2 + margin - 0.001f}, stone), Label::ground);
    EXPECT_EQ(label_of({10.7f, 0.7f, -2 + margin + 0.001f}, stone), Label::nonground);
  }
}

TEST_P(PointHeightsOn, ObstaclesAreHighEnoughAndNotOverhanging) {
  const PointRule rule;
  const Point low{10.4f, 0.4f, -2 + rule.margin - 0.01f};

  EXPECT_EQ(label_of(low, {{10.3f, 0.3f, -2 + 0.75f * rule.obstacle_height - 0.01f}}),
            Label::ground);
  EXPECT_EQ(label_of(low, {{10.3f, 0.3f, -2 + 2.49f}}), Label::nonground);
  EXPECT_EQ(label_of(low, {{10.3f, 0.3f, -2 + 2.51f}}), Label::ground);
}

TEST_P(PointHeightsOn, AnObstacleAffectsOnlyItsSquare) {
  const auto cell_at = [](float distance) {
    return distance < 7.5f ? 0.25f : distance < 23.5f ? 0.5f : distance < 39.5f ? 1.0f : 2.0f;
  };
  for (const float x : {-98.9f, -41.1f, -0.25f, 0.0f, 0.3f, 24.1f, 98.9f}) {
    for (const float y : {-0.3f, 0.0f, 3.7f}) {
      const float cell = cell_at(std::abs(x));
      const auto in_square = [&](float coordinate) {
        return (std::floor(coordinate / cell - 0.5f) + 0.9f) * cell;
      };
      const float in_x = in_square(x) + cell / 2;
      const float in_y = in_square(y) + cell / 2;
      EXPECT_EQ(label_of({in_x, in_y, -1.9f}, {{x, y, -0.5f}}), Label::nonground) << x << " " << y;
      EXPECT_EQ(label_of({in_x, in_y + cell, -1.9f}, {{x, y, -0.5f}}), Label::ground);
      EXPECT_EQ(label_of({in_x, in_y - cell, -1.9f}, {{x, y, -0.5f}}), Label::ground);
    }
  }
}

TEST_P(PointHeightsOn, ObstaclesDoNotAffectTheNextScan) {
  const std::vector<Point> pole = {{10.3f, 0.3f, -1}, {10.4f, 0.4f, -1.9f}};
  const std::vector<Point> none = {{10.3f, 0.3f, -2}, {10.4f, 0.4f, -1.9f}};
  const SurfaceConfig config;
  const tests::SquareScan with_pole(pole, config);
  const tests::SquareScan without(none, config);
  const JoinedGrids joined(level_);
  PointHeights point_heights(config, with_pole.cells, joined.grids());
  point_heights.reserve(2);
  std::vector<float> heights(2);
  std::vector<Label> labels(2);
  const PointHeights::Results results{.heights = heights, .labels = labels};
  const auto label_of_second = [&](const std::vector<Point>& cloud, const tests::SquareScan& scan) {
    LabelTotals totals{};
    point_heights.set_surface(joined.grids());
    point_heights.measure(tests::view_of(cloud), scan.points.unusual(), 0, results, totals);
    point_heights.label(0, results, totals);
    return labels.back();
  };

  // Marks are numbered by scan, and the numbers repeat after 255 scans.
  EXPECT_EQ(label_of_second(pole, with_pole), Label::nonground);
  for (int scan = 0; scan < 600; ++scan) {
    ASSERT_EQ(label_of_second(none, without), Label::ground) << scan;
  }
  EXPECT_EQ(label_of_second(pole, with_pole), Label::nonground);
}

TEST_P(PointHeightsOn, TheNoiseDepthIncreasesWithRange) {
  EXPECT_EQ(label_of({10, 0, -2 - 0.34f}), Label::ground);
  EXPECT_EQ(label_of({10, 0, -2 - 0.36f}), Label::noise);
  EXPECT_EQ(label_of({50, 0, -2 - 1.14f}), Label::ground);
  EXPECT_EQ(label_of({50, 0, -2 - 1.16f}), Label::noise);
}

TEST_P(PointHeightsOn, PointsBelowTheNoiseLimitAreNoiseEvenOnTheSurface) {
  const GroundSurface pit = tests::random_surface([](float, float) { return -20.0f; }, wide_grids);

  EXPECT_EQ(measured({{10, 0, -20}}, pit).labels.front(), Label::noise);
}

TEST_P(PointHeightsOn, NothingIsGroundIfTheSurfaceIsUnknown) {
  const GroundSurface unknown = tests::random_surface([](float, float) { return nan; }, wide_grids);

  EXPECT_EQ(measured({{10, 0, -2}}, unknown).labels.front(), Label::nonground);
  EXPECT_EQ(measured({{10, 0, -200}}, unknown).labels.front(), Label::noise);
}

TEST_P(PointHeightsOn, APointHasTheSameResultAtAnyIndexOfACloud) {
  std::vector<Point> cloud = tests::corrupted_cloud(3000, 5);
  cloud.push_back({10.3f, 0.3f, -1});
  cloud.push_back(
      {10.4f, 0.4f, -1.9f});  // undecided until the square is known to contain an obstacle
  const Measured whole = measured(cloud, level_);
  // Points are read in blocks of 16 and looked up in groups of 512.
  for (const std::size_t omitted : {1U, 5U, 15U, 16U, 17U, 500U, 512U, 1025U}) {
    const std::vector<Point> rest(cloud.begin() + static_cast<std::ptrdiff_t>(omitted),
                                  cloud.end());

    const Measured found = measured(rest, level_);

    for (std::size_t i = 0; i < rest.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(found.heights[i]),
                std::bit_cast<std::uint32_t>(whole.heights[i + omitted]))
          << i << " after " << omitted;
    }
    EXPECT_EQ(found.labels.back(), Label::nonground);
  }
}

TEST_P(PointHeightsOn, ChunksCanBeMeasuredInAnyOrder) {
  const std::vector<Point> cloud = tests::random_cloud(3 * plane_fits::chunk_size + 5, 6);
  const SurfaceConfig config;
  const Measured expected = measured(cloud, level_);
  const tests::SquareScan sorted(cloud, config);
  const JoinedGrids joined(level_);
  PointHeights point_heights(config, sorted.cells, joined.grids());
  point_heights.reserve(cloud.size());
  std::vector<float> heights(cloud.size());
  std::vector<Label> labels(cloud.size());
  const PointHeights::Results results{.heights = heights, .labels = labels};
  LabelTotals totals{};

  point_heights.set_surface(joined.grids());
  for (const std::size_t chunk : {2U, 0U, 3U, 1U}) {
    point_heights.measure(tests::view_of(cloud), sorted.points.unusual(), chunk, results, totals);
  }
  for (const std::size_t chunk : {1U, 3U, 0U, 2U}) point_heights.label(chunk, results, totals);

  EXPECT_EQ(labels, expected.labels);
  EXPECT_EQ(totals, expected.totals);
}

TEST_P(PointHeightsOn, TotalsCountTheLabelsOfEveryChunk) {
  const std::vector<Point> cloud = tests::corrupted_cloud(20000, 3);

  const Measured found = measured(cloud, level_);

  LabelTotals counted{};
  for (const Label label : found.labels) ++counted.at(static_cast<std::size_t>(label));
  for (const Label label : {Label::ground, Label::noise, Label::out_of_range, Label::invalid}) {
    const auto code = static_cast<std::size_t>(label);
    EXPECT_EQ(found.totals.at(code), counted.at(code)) << to_string(label);
    EXPECT_GT(counted.at(code), 0U) << to_string(label);
  }
}

}  // namespace
}  // namespace flagstone::surface
