// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// The effect of each setting of the fit, on bins with known sets. The comparison of Patchwork with
// its oracle covers whole fits.
#include "library/plane_fits/plane_fit.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
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

}  // namespace
}  // namespace flagstone::plane_fits
