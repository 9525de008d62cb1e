// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The effect of each setting of the fit, on bins with known sets. The comparison of Patchwork with
// its oracle covers whole fits.
#include "library/plane_fits/plane_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "library/plane_fits/batch_of.hpp"
#include "library/plane_fits/stage_clock.hpp"
#include "numbers.hpp"

namespace flagstone::plane_fits {
namespace {

using Heights = std::vector<float>;

/// 300 points of level ground, 1.7 m below the sensor, and these points.
Heights ground_and(const Heights& others) {
  Heights heights(300, -1.7f);
  heights.insert(heights.end(), others.begin(), others.end());
  return heights;
}

/// Settings that fit one plane, to the first set.
FitSettings first_set_only() {
  return {.seed_height = 0.5,
          .distance_margin = 0.125,
          .noise_margin = 0.375,
          .iterations = 1,
          .keep_below_floor = true,
          .evaluate_final_set = false};
}

/// The same seeds for each bin.
Seeds same_seeds(double floor, std::uint32_t count) {
  Seeds seeds{};
  seeds.floors.fill(floor);
  seeds.counts.fill(count);
  return seeds;
}

PlaneFit::Result fitted(const std::vector<Heights>& bins, const FitSettings& settings,
                        const Seeds& seeds) {
  BinBatch batch = tests::batch_of(bins);
  std::size_t points = 0;
  for (const Heights& heights : bins) points += heights.size();
  PlaneFit fit(settings);
  fit.reserve(points);
  StageClock clock(nullptr);
  PlaneFit::Result result;
  fit.fit(batch, seeds, clock, result);
  return result;
}

TEST(PlaneFit, FirstSetEndsTheSeedHeightAboveTheMeanOfTheSeeds) {
  const Heights heights = ground_and({-1.25f, -1.15f});

  const PlaneFit::Result result = fitted({heights}, first_set_only(), same_seeds(-inf, 20));

  EXPECT_EQ(result.judged.count[0], 301);
}

TEST(PlaneFit, FirstSetBeginsTheSeedDepthBelowTheMeanOfTheSeeds) {
  const Heights heights = ground_and({-2.65f, -3.5f});
  FitSettings settings = first_set_only();
  const Seeds seeds = same_seeds(-inf, 200);  // their mean is 1.4 cm below the ground

  EXPECT_EQ(fitted({heights}, settings, seeds).judged.count[0], 302);
  settings.seed_depth = 1;
  EXPECT_EQ(fitted({heights}, settings, seeds).judged.count[0], 301);
}

TEST(PlaneFit, FirstSetContainsPointsBelowTheFloorOnlyIfConfigured) {
  const Heights heights = ground_and({-3.0f, -2.0f});
  FitSettings settings = first_set_only();
  const Seeds seeds = same_seeds(-2.25, 20);

  EXPECT_EQ(fitted({heights}, settings, seeds).judged.count[0], 302);
  settings.keep_below_floor = false;
  EXPECT_EQ(fitted({heights}, settings, seeds).judged.count[0], 301);
}

TEST(PlaneFit, SeedDepthAndFloorBothApply) {
  const Heights heights = ground_and({-3.0f, -2.0f});
  FitSettings settings = first_set_only();
  settings.keep_below_floor = false;

  settings.seed_depth = 0.1;
  EXPECT_EQ(fitted({heights}, settings, same_seeds(-2.25, 200)).judged.count[0], 300);
  settings.seed_depth = 10;
  EXPECT_EQ(fitted({heights}, settings, same_seeds(-2.25, 200)).judged.count[0], 301);
}

TEST(PlaneFit, FloorIsPerBin) {
  const Heights heights = ground_and({-3.5f, -3.5f});
  Seeds seeds = same_seeds(-inf, 1);
  seeds.floors[1] = -2;

  const PlaneFit::Result result = fitted({heights, heights}, first_set_only(), seeds);

  EXPECT_EQ(result.exists, 0b10U);  // two points far below all others have no plane
  EXPECT_EQ(result.judged.count[1], 302);
}

TEST(PlaneFit, NumberOfSeedsIsPerBin) {
  const Heights heights = ground_and({-3.5f, -3.5f});
  Seeds seeds = same_seeds(-inf, 2);
  seeds.counts[1] = 100;
  seeds.counts[2] = 30;

  const PlaneFit::Result result = fitted({heights, heights, heights}, first_set_only(), seeds);

  EXPECT_EQ(result.exists, 0b110U);
  EXPECT_EQ(result.judged.count[1], 302);
}

TEST(PlaneFit, LaterSetsExtendFromTheNoiseMarginBelowToTheDistanceMarginAboveThePlane) {
  const Heights heights = ground_and({-1.6f, -1.55f, -2.05f, -2.15f});
  FitSettings settings = first_set_only();
  settings.iterations = 2;

  const PlaneFit::Result result = fitted({heights}, settings, same_seeds(-inf, 20));

  EXPECT_EQ(result.judged.count[0], 302);
}

TEST(PlaneFit, EvaluatingTheFinalSetFitsOneMorePlane) {
  const Heights heights = ground_and({-1.6f, -1.55f, -1.4f, -2.05f, -2.15f});
  FitSettings settings = first_set_only();
  settings.iterations = 2;
  settings.evaluate_final_set = true;
  const Seeds seeds = same_seeds(-inf, 20);

  const PlaneFit::Result judged = fitted({heights}, settings, seeds);
  settings.iterations = 3;
  settings.evaluate_final_set = false;
  const PlaneFit::Result three = fitted({heights}, settings, seeds);

  EXPECT_EQ(judged.judged.d[0], three.judged.d[0]);
  EXPECT_EQ(judged.judged.normal[2][0], three.judged.normal[2][0]);
}

TEST(PlaneFit, PlanesAreRelativeToTheirOrigins) {
  const PlaneFit::Result result = fitted({ground_and({})}, first_set_only(), same_seeds(-inf, 20));

  const Plane plane = result.judged[0].moved_by(result.origins[0]);

  EXPECT_NEAR(plane.d, 1.7, 1e-6);
  EXPECT_NEAR(plane.normal[2], 1, 1e-9);
}

/// The points of a bin, relative to its origin.
using Points = std::vector<std::array<float, 3>>;

/// A batch of one bin with this origin.
BinBatch batch_of_one(const Points& points, BinBatch::Origin origin) {
  BinBatch batch;
  batch.reserve(points.size());
  batch.clear();
  batch.add_empty(points.size(), origin);
  for (std::size_t k = 0; k < batch.places(0); ++k) {
    const bool is_point = k < points.size();
    batch.x(0)[k] = is_point ? points[k][0] : 0;
    batch.y(0)[k] = is_point ? points[k][1] : 0;
    batch.z(0)[k] = is_point ? points[k][2] : float{inf};
  }
  return batch;
}

/// Points on the grid of ExactGrid: rough ground around a height of 0, and a bush on it.
Points ground_on_the_grid(std::mt19937& random) {
  const auto any = [&](int from, int to) {
    return static_cast<float>(from + static_cast<int>(random() % static_cast<unsigned>(to - from)));
  };
  Points points;
  for (int i = 0; i < 100; ++i) {
    const float z = i < 70 ? any(-20, 20) : any(20, 300);
    points.push_back({any(-512, 512) * ExactGrid::xy_step, any(-512, 512) * ExactGrid::xy_step,
                      z * ExactGrid::z_step});
  }
  return points;
}

PlaneFit::Result fitted_exactly(const Points& points, BinBatch::Origin origin) {
  BinBatch batch = batch_of_one(points, origin);
  FitSettings settings = first_set_only();
  settings.seed_depth = 1;
  settings.iterations = 3;
  settings.exact = true;
  PlaneFit fit(settings);
  fit.reserve(points.size());
  StageClock clock(nullptr);
  PlaneFit::Result result;
  fit.fit(batch, same_seeds(-inf, 20), clock, result);
  return result;
}

TEST(PlaneFit, AnExactPlaneDoesNotDependOnTheOrderOfThePoints) {
  std::mt19937 random(1);
  for (int scan = 0; scan < 20; ++scan) {
    Points points = ground_on_the_grid(random);
    const PlaneFit::Result expected = fitted_exactly(points, {.x = 0, .y = 0});
    ASSERT_TRUE(expected.has_plane(0));
    for (int repeat = 0; repeat < 5; ++repeat) {
      std::ranges::shuffle(points, random);

      const PlaneFit::Result found = fitted_exactly(points, {.x = 0, .y = 0});

      ASSERT_TRUE(found.has_plane(0));
      EXPECT_EQ(found.origins[0], expected.origins[0]);
      EXPECT_EQ(found.judged[0].normal, expected.judged[0].normal);
      EXPECT_EQ(found.judged[0].d, expected.judged[0].d);
      EXPECT_EQ(found.judged[0].count, expected.judged[0].count);
    }
  }
}

TEST(PlaneFit, TheOriginOfABinMovesItsPlane) {
  std::mt19937 random(2);
  const Points points = ground_on_the_grid(random);

  const Plane plane = fitted_exactly(points, {.x = 0, .y = 0}).plane(0);
  const Plane moved = fitted_exactly(points, {.x = 20, .y = -12, .z = -1.75f}).plane(0);

  EXPECT_EQ(moved.normal, plane.normal);
  EXPECT_NEAR(moved.mean[0], plane.mean[0] + 20, 1e-12);
  EXPECT_NEAR(moved.mean[1], plane.mean[1] - 12, 1e-12);
  EXPECT_NEAR(moved.mean[2], plane.mean[2] - 1.75, 1e-12);
}

}  // namespace
}  // namespace flagstone::plane_fits
