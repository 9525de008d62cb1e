// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/cell_observations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/owned_grid.hpp"

namespace flagstone::surface {
namespace {

using plane_fits::MovedPoint;
using tests::OwnedGrid;

constexpr float gate = 0.4f;
constexpr float gate_per_metre = 0.004f;
constexpr float max_clutter_ratio = 0.5f;
constexpr float lower_bound_weight = 0.1f;

/// The observation of a cell.
struct Observation {
  double weight = 0;  ///< 0 without an observation
  double correction = 0;
};

/// A naive implementation of the observation, from the header and the constants of the code.
/// `heights`: heights above the surface of up to 32 points, metres.
Observation naive(const std::vector<double>& heights, double reach) {
  std::vector<double> gated;
  std::vector<double> seen;
  for (const double h : heights) {
    if (std::abs(h) <= reach) gated.push_back(h);
    if (h <= -(reach + 1.5) || h >= reach + 1) continue;
    seen.push_back(h);
  }
  std::ranges::sort(seen);
  std::size_t alone = 0;  // up to two points far below the next
  while (alone < 2 && alone + 1 < seen.size() && seen[alone + 1] - seen[alone] > 0.2) ++alone;
  const double lowest = seen.empty() ? std::numeric_limits<double>::infinity() : seen[alone];
  const auto lower_bound = [&]() -> Observation {
    if (seen.size() < 8 || lowest >= -0.03) return {};
    return {.weight = static_cast<double>(lower_bound_weight), .correction = lowest};
  };
  if (gated.size() < 3) return lowest < -reach ? lower_bound() : Observation{};

  std::ranges::sort(gated);
  double mean = gated.size() < 5 ? gated[0] : gated[gated.size() < 10 ? 1 : 2];
  const auto in_window = [&](double h) { return std::abs(h - mean) <= 0.12; };
  for (int step = 0; step < 2; ++step) {
    double sum = 0;
    double count = 0;
    for (const double h : gated) {
      if (!in_window(h)) continue;
      sum += h;
      ++count;
    }
    mean = sum / std::max(count, 1.0);
  }
  const auto at_surface = static_cast<double>(std::ranges::count_if(gated, in_window));
  const auto above = static_cast<double>(std::ranges::count_if(
      heights, [&](double h) { return h > mean + 0.18 && h < std::min(mean + 0.88, reach + 1); }));
  const auto below =
      static_cast<double>(std::ranges::count_if(gated, [&](double h) { return h < mean - 0.144; }));
  if (at_surface < 3) return {};
  if (above > static_cast<double>(max_clutter_ratio) * at_surface) return lower_bound();
  if (below > 0.05 * at_surface) return {};
  return {.weight = std::min(1.0, at_surface / 10), .correction = mean};
}

/// Points in the cells of a grid of 8 x 8 cells of 1 m, and their observations. The parameter is
/// the instruction set.
class CellObservations : public testing::TestWithParam<std::string> {
 protected:
  /// Adds a cell with points at random positions and these heights above the surface, metres.
  void add_cell(std::uint32_t row, std::uint32_t column, const std::vector<float>& heights) {
    const Grid& grid = grid_.grid();
    cells_.push_back({.first = static_cast<std::uint32_t>(points_.size()),
                      .count = static_cast<std::uint32_t>(heights.size()),
                      .row = row,
                      .column = column});
    for (const float height : heights) {
      const float x = grid.center(column) + offset_(random_);
      const float y = grid.center(row) + offset_(random_);
      points_.push_back({.x = x, .y = y, .z = ground(x, y) + height, .index = 0});
    }
  }

  void observe_all(CellSize size = CellSize::any) {
    grid_.set([this](float x, float y) { return ground(x, y); });
    std::vector<MovedPoint> readable = points_;
    readable.resize(points_.size() + 16);
    observe({.points = readable.data(),
             .surface = &grid_.grid(),
             .gate = gate,
             .gate_per_metre = gate_per_metre,
             .max_clutter_ratio = max_clutter_ratio,
             .lower_bound_weight = lower_bound_weight,
             .corrections = corrections_.data(),
             .weights = weights_.data()},
            cells_, size);
  }

  /// The observation of a single cell near the sensor.
  Observation observed(const std::vector<float>& heights) {
    add_cell(4, 4, heights);
    observe_all();
    return observation(4, 4);
  }

  [[nodiscard]] Observation observation(std::size_t row, std::size_t column) const {
    return {.weight = weights_[row * 8 + column], .correction = corrections_[row * 8 + column]};
  }

  /// Tilted, so that heights differ from z.
  [[nodiscard]] float ground(float x, float y) const {
    return heights_are_z_ ? 0 : -1.75f + 0.25f * x - 0.125f * y;
  }

  [[nodiscard]] double reach(std::size_t row, std::size_t column) const {
    const Grid& grid = grid_.grid();
    return static_cast<double>(gate +
                               gate_per_metre * std::hypot(grid.center(column), grid.center(row)));
  }

  bool heights_are_z_ = false;
  std::mt19937 random_{1};
  std::uniform_real_distribution<float> offset_{-0.5f, 0.5f};
  OwnedGrid grid_{1, 8};
  std::vector<MovedPoint> points_;
  std::vector<OccupiedCell> cells_;
  std::vector<float> corrections_ = std::vector<float>(64, 0.0f);
  std::vector<float> weights_ = std::vector<float>(64, 0.0f);

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, CellObservations, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

/// `count` heights that increase by `step` from `lowest`.
std::vector<float> rising(float lowest, float step, std::size_t count) {
  std::vector<float> heights(count);
  for (std::size_t i = 0; i < count; ++i) heights[i] = lowest + step * static_cast<float>(i);
  return heights;
}

TEST_P(CellObservations, FlatGroundGivesItsHeightAboveTheSurface) {
  const Observation ground = observed(std::vector<float>(20, 0.1f));

  EXPECT_EQ(ground.weight, 1);
  EXPECT_NEAR(ground.correction, 0.1, 1e-6);
}

TEST_P(CellObservations, FewerPointsHaveLessWeight) {
  EXPECT_NEAR(observed(std::vector<float>(4, -0.1f)).weight, 0.4, 1e-6);
}

TEST_P(CellObservations, TwoPointsGiveNoObservation) {
  EXPECT_EQ(observed({0.1f, 0.1f, 2.5f}).weight, 0);
}

TEST_P(CellObservations, AKerbGivesTheHeightOfItsLowerSide) {
  // Ten points in a gutter, and eight on the pavement 14 cm above, which is too low to be an
  // obstacle.
  std::vector<float> kerb(10, 0.0f);
  kerb.insert(kerb.end(), 8, 0.14f);

  const Observation side = observed(kerb);

  EXPECT_EQ(side.weight, 1);
  EXPECT_NEAR(side.correction, 0, 0.03);
}

TEST_P(CellObservations, AWallGivesOnlyALowerBoundAtItsBase) {
  const std::vector<float> wall = rising(-0.2f, 0.05f, 24);

  const Observation bound = observed(wall);

  EXPECT_NEAR(bound.weight, lower_bound_weight, 1e-6);
  EXPECT_NEAR(bound.correction, -0.2, 1e-6);
}

TEST_P(CellObservations, AWallWithItsBaseAtTheSurfaceGivesNoObservation) {
  const std::vector<float> wall = rising(-0.02f, 0.05f, 24);

  EXPECT_EQ(observed(wall).weight, 0);
}

TEST_P(CellObservations, AGhostPointFarBelowChangesNothing) {
  std::vector<float> heights(20, 0.05f);
  heights.push_back(-1.0f);

  const Observation ground = observed(heights);

  EXPECT_EQ(ground.weight, 1);
  EXPECT_NEAR(ground.correction, 0.05, 1e-6);
}

TEST_P(CellObservations, SeveralPointsBelowTheModeGiveNoObservation) {
  // The two low points are too few for a mode of their height, and too many below the mode above
  // them.
  std::vector<float> heights = {-0.3f, -0.3f};
  heights.insert(heights.end(), 20, 0.1f);

  EXPECT_EQ(observed(heights).weight, 0);
}

TEST_P(CellObservations, PointsExactlyAtTheLimitAreNotBelowTheMode) {
  heights_are_z_ = true;  // so that heights are exact
  std::vector<float> heights(20, 0.0f);
  heights.insert(heights.end(), 2, -0.144f);

  EXPECT_EQ(observed(heights).weight, 1);
}

TEST_P(CellObservations, PointsExactlyAtTheLimitAreNotAnObstacle) {
  heights_are_z_ = true;  // so that heights are exact
  std::vector<float> heights(20, 0.0f);
  heights.insert(heights.end(), 11, 0.18f);

  EXPECT_EQ(observed(heights).weight, 1);
}

TEST_P(CellObservations, ABushAboveTheSurfaceGivesNoObservation) {
  const std::vector<float> bush = rising(0.1f, 0.04f, 20);

  EXPECT_EQ(observed(bush).weight, 0);
}

TEST_P(CellObservations, PointsTooFarAboveAreIgnored) {
  std::vector<float> heights(12, 0.0f);
  heights.insert(heights.end(), 18, 1.6f);  // a car door or foliage

  EXPECT_EQ(observed(heights).weight, 1);
}

TEST_P(CellObservations, WriteOnlyObservedCells) {
  std::ranges::fill(corrections_, 7.0f);
  std::ranges::fill(weights_, 7.0f);
  add_cell(2, 3, std::vector<float>(12, 0.1f));
  add_cell(2, 4, {0.1f});

  observe_all();

  EXPECT_EQ(observation(2, 3).weight, 1);
  EXPECT_EQ(observation(2, 4).weight, 7);
  EXPECT_EQ(observation(2, 4).correction, 7);
  EXPECT_EQ(observation(3, 3).weight, 7);
}

TEST_P(CellObservations, UseThirtyTwoEvenlySelectedPoints) {
  // Every second point lies 0.3 m higher and is not among the selected points j * 64 / 32.
  std::vector<float> heights(64, 0.0f);
  for (std::size_t i = 1; i < heights.size(); i += 2) heights[i] = 0.3f;

  const Observation ground = observed(heights);

  EXPECT_EQ(ground.weight, 1);
  EXPECT_NEAR(ground.correction, 0, 1e-6);
}

TEST_P(CellObservations, TwoReflectionsBelowAWallAreNotItsBase) {
  std::vector<float> wall = rising(-0.1f, 0.05f, 24);
  wall.insert(wall.end(), {-1.2f, -0.7f});

  EXPECT_NEAR(observed(wall).correction, -0.1, 1e-6);
}

TEST_P(CellObservations, SmallCellsGiveTheSameResultWithBothSizes) {
  add_cell(1, 1, rising(-0.2f, 0.06f, small_cell));
  add_cell(2, 5, std::vector<float>(small_cell, 0.15f));
  observe_all(CellSize::any);
  const std::vector<float> corrections(corrections_.begin(), corrections_.end());
  const std::vector<float> weights(weights_.begin(), weights_.end());

  observe_all(CellSize::small);

  EXPECT_THAT(corrections, testing::ElementsAreArray(corrections_));
  EXPECT_THAT(weights, testing::ElementsAreArray(weights_));
}

TEST_P(CellObservations, MatchANaiveImplementation) {
  std::uniform_real_distribution<float> share(0, 1);
  for (int repeat = 0; repeat < 40; ++repeat) {
    points_.clear();
    cells_.clear();
    std::ranges::fill(corrections_, 0.0f);
    std::ranges::fill(weights_, 0.0f);
    std::vector<std::vector<float>> all;
    // Cells inside the grid, with a known slope of the surface on both sides.
    for (std::uint32_t row = 1; row < 7; ++row) {
      for (std::uint32_t column = 1; column < 7; ++column) {
        if (share(random_) < 0.2f) continue;
        // Rough ground, and fractions of points above and below it.
        const float middle = 0.8f * share(random_) - 0.4f;
        const float roughness = 0.2f * share(random_);
        const float standing = share(random_) * share(random_);
        const float below = 0.3f * share(random_) * share(random_);
        std::vector<float> heights(3 + random_() % 30);
        for (float& height : heights) {
          height = middle + roughness * (share(random_) - 0.5f);
          if (share(random_) < standing) height += 1.5f * share(random_);
          if (share(random_) < below) height -= 2 * share(random_);
        }
        add_cell(row, column, heights);
        all.push_back(heights);
      }
    }

    observe_all();

    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const OccupiedCell& cell = cells_[i];
      const Observation expected =
          naive({all[i].begin(), all[i].end()}, reach(cell.row, cell.column));
      const Observation found = observation(cell.row, cell.column);
      ASSERT_NEAR(found.weight, expected.weight, 1e-6) << "cell " << i << ", repeat " << repeat;
      ASSERT_NEAR(found.correction, expected.correction, 1e-5);
    }
  }
}

}  // namespace
}  // namespace flagstone::surface
