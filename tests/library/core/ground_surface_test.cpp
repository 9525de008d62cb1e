// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/ground_surface.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "numbers.hpp"
#include "random_surface.hpp"

namespace flagstone {
namespace {

using tests::random_surface;
using tests::two_grids;

/// One grid of 1 m cells with centres at x, y = -1.5, -0.5, 0.5, 1.5.
GroundSurface of_sixteen(const tests::Ground& ground) {
  return random_surface(ground, std::vector<tests::GridSize>{{.cell = 1, .width = 4}});
}

bool is_not_known(const GroundSurface& surface, float x, float y) {
  const GroundSample ground = surface.at(x, y);
  return std::isnan(surface.height(x, y)) && std::isnan(ground.height) &&
         std::isnan(ground.normal[0]) && std::isnan(ground.normal[1]) &&
         std::isnan(ground.normal[2]) && std::isnan(ground.slope) && ground.confidence == 0;
}

/// -1 to 1.
rc::Gen<float> any_share() {
  return rc::gen::map(rc::gen::inRange(-1'000'000, 1'000'001),
                      [](int millionths) { return static_cast<float>(millionths) / 1e6f; });
}

/// Smooth ground, for properties of every surface.
float hills(float x, float y) { return 0.4f * std::sin(x / 3) - 0.3f * std::cos(y / 2 + x / 7); }

TEST(GroundSurface, IsEmptyAndUnknownEverywhereUntilFilled) {
  GroundSurface surface;

  EXPECT_TRUE(surface.empty());
  EXPECT_EQ(surface.extent(), 0);
  EXPECT_TRUE(std::isnan(surface.resolution(0, 0)));
  EXPECT_TRUE(is_not_known(surface, 0, 0));
}

TEST(GroundSurface, IsUnknownEverywhereIfItsGridsHaveNoCells) {
  GroundSurface surface;
  surface.start().resize(2);

  EXPECT_TRUE(is_not_known(surface, 0, 0));
  EXPECT_TRUE(is_not_known(surface, 1, -1));
}

TEST(GroundSurface, IsUnknownEverywhereAfterClear) {
  GroundSurface surface = random_surface([](float, float) { return -1.7f; });
  surface.clear();

  EXPECT_TRUE(surface.empty());
  EXPECT_EQ(surface.extent(), 0);
  EXPECT_TRUE(is_not_known(surface, 0, 0));
}

TEST(GroundSurface, HasTheExtentOfItsCoarsestGrid) {
  const GroundSurface surface = random_surface(hills, two_grids);

  EXPECT_EQ(surface.extent(), 32);
  EXPECT_FALSE(is_not_known(surface, 32, -32));
  EXPECT_TRUE(is_not_known(surface, 32.001f, 0));
  EXPECT_TRUE(is_not_known(surface, 0, -32.001f));
}

TEST(GroundSurface, HasTheResolutionOfTheFinestGridAtThePosition) {
  const GroundSurface surface = random_surface(hills, two_grids);

  EXPECT_EQ(surface.resolution(0, 0), 0.25f);
  EXPECT_EQ(surface.resolution(-7.875f, 7.875f), 0.25f);  // the last centre
  EXPECT_EQ(surface.resolution(-7.876f, 7.875f), 1);
  EXPECT_EQ(surface.resolution(32, 32), 1);
  EXPECT_TRUE(std::isnan(surface.resolution(32.001f, 0)));
}

TEST(GroundSurface, UsesTheFinestOfGridsWithEqualExtentUpToTheEdge) {
  GroundSurface surface = random_surface(
      hills, std::vector<tests::GridSize>{{.cell = 2, .width = 8}, {.cell = 1, .width = 16}});
  std::ranges::fill(surface.start()[1].heights, -1.0f);

  EXPECT_EQ(surface.resolution(7.6f, 0), 1);
  EXPECT_EQ(surface.height(7.6f, 0), -1);
  EXPECT_EQ(surface.height(-8, 8), -1);
}

TEST(GroundSurface, UsesHeightsOfTheFinestGridAtThePosition) {
  GroundSurface surface = random_surface([](float, float) { return -2.0f; }, two_grids);
  std::ranges::fill(surface.start()[1].heights, -1.0f);

  EXPECT_EQ(surface.height(7.875f, 7.875f), -1);
  EXPECT_EQ(surface.height(7.876f, 7.875f), -2);
}

TEST(GroundSurface, EqualsTheHeightOfACellAtItsCentre) {
  const GroundSurface surface = of_sixteen([](float x, float y) { return 10 * x + y * y; });

  EXPECT_EQ(surface.height(-1.5f, -0.5f), -14.75f);
  EXPECT_EQ(surface.height(0.5f, 1.5f), 7.25f);
  EXPECT_EQ(surface.height(1.5f, 1.5f), 17.25f);
}

TEST(GroundSurface, IsBilinearBetweenCellCentres) {
  const GroundSurface surface =
      of_sixteen([](float x, float y) { return x > 0 && y > 0 ? 1.0f : 0.0f; });

  EXPECT_EQ(surface.height(0, 0), 0.25f);
  EXPECT_EQ(surface.height(0.25f, 0.25f), 0.5625f);
  EXPECT_EQ(surface.height(1, 0.25f), 0.75f);
}

TEST(GroundSurface, IsConstantBeyondTheLastCellCentres) {
  const GroundSurface surface = of_sixteen([](float x, float y) { return x + 2 * y; });

  EXPECT_EQ(surface.height(2, 2), surface.height(1.5f, 1.5f));
  EXPECT_EQ(surface.height(-1.75f, 0.25f), surface.height(-1.5f, 0.25f));
  EXPECT_EQ(surface.at(2, -2).normal, surface.at(1.5f, -1.5f).normal);
  EXPECT_EQ(surface.at(0.25f, -2).slope, surface.at(0.25f, -1.5f).slope);
}

TEST(GroundSurface, HasBilinearConfidence) {
  GroundSurface surface = of_sixteen([](float, float) { return 0.0f; });
  std::vector<float>& confidences = surface.start()[0].confidences;
  std::ranges::fill(confidences, 0.25f);
  confidences[5] = 0.75f;  // at (-0.5, -0.5)

  EXPECT_EQ(surface.at(-0.5f, -0.5f).confidence, 0.75f);
  EXPECT_EQ(surface.at(-1, -0.5f).confidence, 0.5f);
  EXPECT_EQ(surface.at(0, 0).confidence, 0.375f);
}

TEST(SurfaceWithAHole, IsUnknownWhereAnUnknownCellHasAWeight) {
  const GroundSurface surface =
      of_sixteen([](float x, float y) { return x == 0.5f && y == 0.5f ? nan : 1; });

  EXPECT_TRUE(is_not_known(surface, 0.5f, 0.5f));
  EXPECT_TRUE(is_not_known(surface, 1.499f, 1.499f));
  EXPECT_TRUE(is_not_known(surface, -0.499f, 0.5f));
}

TEST(SurfaceWithAHole, IsKnownWhereTheUnknownCellHasNoWeight) {
  const GroundSurface surface =
      of_sixteen([](float x, float y) { return x == 0.5f && y == 0.5f ? nan : 1; });

  for (const float along : {-0.5f, 1.5f}) {
    EXPECT_EQ(surface.height(along, 0.25f), 1);
    EXPECT_EQ(surface.height(0.25f, along), 1);
    EXPECT_EQ(surface.at(along, 0.5f).height, 1);
    EXPECT_EQ(surface.at(along, 0.5f).confidence, 1);
  }
}

TEST(SurfaceWithAHole, HasNoNormalIfOneOfTheFourHeightsIsUnknown) {
  const GroundSurface surface =
      of_sixteen([](float x, float y) { return x == 0.5f && y == 0.5f ? nan : 1; });
  const GroundSample ground = surface.at(-0.5f, 0.25f);  // on a line of centres, next to the hole

  EXPECT_EQ(ground.height, 1);
  EXPECT_TRUE(std::isnan(ground.normal[2]));
  EXPECT_TRUE(std::isnan(ground.slope));
}

TEST(SurfaceAt, ReturnsSlopeAndDirection) {
  const GroundSurface rises_ahead = random_surface([](float x, float) { return x; });
  const GroundSurface falls_to_the_left = random_surface([](float, float y) { return -2 * y; });

  const GroundSample ahead = rises_ahead.at(3.1f, -4.2f);
  EXPECT_NEAR(ahead.slope, std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(ahead.normal[0], -std::numbers::sqrt2 / 2, 1e-6);
  EXPECT_NEAR(ahead.normal[1], 0, 1e-6);
  EXPECT_NEAR(ahead.normal[2], std::numbers::sqrt2 / 2, 1e-6);
  EXPECT_NEAR(falls_to_the_left.at(0, 0).normal[1], 2 / std::sqrt(5), 1e-6);
}

TEST(SurfaceAt, IsSteepAtAKerb) {
  const GroundSurface kerb = random_surface([](float, float y) { return y > 3 ? -1.55f : -1.7f; });

  EXPECT_NEAR(kerb.at(0, 3).slope, std::atan(0.15f / 0.25f), 1e-5);
  EXPECT_EQ(kerb.at(0, 2.5f).slope, 0);
}

RC_GTEST_PROP(SurfaceAt, ReproducesEveryPlane, ()) {
  const float along_x = 2 * *any_share();
  const float along_y = 2 * *any_share();
  const float offset = 3 * *any_share();
  const auto plane = [&](float x, float y) { return offset + along_x * x + along_y * y; };
  const GroundSurface surface = random_surface(plane);
  const float length = std::hypot(along_x, along_y, 1.0f);

  for (int place = 0; place < 20; ++place) {
    const float x = 31.5f * *any_share();  // up to the last centres
    const float y = 31.5f * *any_share();
    const GroundSample ground = surface.at(x, y);

    RC_ASSERT(std::abs(ground.height - plane(x, y)) < 5e-5f);
    RC_ASSERT(std::abs(ground.normal[0] + along_x / length) < 1e-4f);
    RC_ASSERT(std::abs(ground.normal[1] + along_y / length) < 1e-4f);
    RC_ASSERT(std::abs(ground.normal[2] - 1 / length) < 1e-4f);
    RC_ASSERT(std::abs(ground.slope - std::atan(std::hypot(along_x, along_y))) < 1e-4f);
    RC_ASSERT(ground.confidence == 1);
  }
}

RC_GTEST_PROP(SurfaceHeight, IsContinuousWithinAGrid, ()) {
  static const GroundSurface surface = random_surface(hills);
  const float x = 31 * *any_share();
  const float y = 31 * *any_share();
  const float to_x = x + 1e-3f * *any_share();
  const float to_y = y + 1e-3f * *any_share();
  RC_PRE(surface.resolution(x, y) == surface.resolution(to_x, to_y));

  // The slope of the ground is at most 0.25 m/m; the rest is rounding.
  RC_ASSERT(std::abs(surface.height(x, y) - surface.height(to_x, to_y)) < 0.25f * 2e-3f + 1e-5f);
}

RC_GTEST_PROP(SurfaceHeight, EqualsTheHeightFromAt, ()) {
  static const GroundSurface surface =
      random_surface([](float x, float y) { return std::sin(x * y) > 0.9f ? nan : hills(x, y); });
  const float x = 33 * *any_share();
  const float y = 33 * *any_share();

  RC_ASSERT(std::bit_cast<std::uint32_t>(surface.height(x, y)) ==
            std::bit_cast<std::uint32_t>(surface.at(x, y).height));
}

RC_GTEST_PROP(SurfaceHeight, IsWithinTheRangeOfTheSurroundingHeights, ()) {
  static const GroundSurface surface = random_surface(hills);
  const float height = surface.height(32 * *any_share(), 32 * *any_share());

  RC_ASSERT(height >= -0.7f);
  RC_ASSERT(height <= 0.7f);
}

RC_GTEST_PROP(SurfaceAt, AcceptsCoordinatesOfAnyValue, ()) {
  static const GroundSurface surface = random_surface(hills);
  const auto special =
      rc::gen::element(nan, inf, -inf, -0.0f, 32.0f, -32.0f, 8.0f,
                       std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min());
  const auto any_bits = rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                                     [](std::uint32_t bits) { return std::bit_cast<float>(bits); });
  const float x = *rc::gen::oneOf(special, any_bits);
  const float y = *rc::gen::oneOf(special, any_bits);

  const bool is_covered = std::abs(x) <= 32 && std::abs(y) <= 32;

  RC_ASSERT(std::isnan(surface.height(x, y)) == !is_covered);
  RC_ASSERT(is_not_known(surface, x, y) == !is_covered);
  RC_ASSERT(std::isnan(surface.resolution(x, y)) == !is_covered);
}

}  // namespace
}  // namespace flagstone
