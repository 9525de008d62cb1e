// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/lower_plane.hpp"

#include <gtest/gtest.h>

namespace flagstone::plane_fits {
namespace {

double squared(double v) { return v * v; }

/// The plane of 20 points below the ground; `along`, `across` and `thickness` are their standard
/// deviations, metres.
Plane plane(double along = 1, double across = 0.5, double thickness = 0.01) {
  return {.count = 20,
          .mean = {8, 1, -3},
          .normal = {0, 0, 1},
          .d = 3,
          .eigenvalues = {squared(along), squared(across), squared(thickness)}};
}

TEST(LowerPlane, IsGroundIfMostPointsBelowAreInIt) {
  EXPECT_TRUE(is_lower_ground(plane(), 20));
  EXPECT_TRUE(is_lower_ground(plane(), 33));   // 61 % of them
  EXPECT_FALSE(is_lower_ground(plane(), 34));  // 59 %
}

TEST(LowerPlane, RequiresTwelvePoints) {
  Plane small = plane();
  small.count = 12;
  EXPECT_TRUE(is_lower_ground(small, 12));
  small.count = 11;
  EXPECT_FALSE(is_lower_ground(small, 11));
}

TEST(LowerPlane, RequiresLengthAndWidthOrMoreLength) {
  EXPECT_TRUE(is_lower_ground(plane(0.31, 0.11), 20));
  EXPECT_FALSE(is_lower_ground(plane(0.29, 0.11), 20));
  EXPECT_FALSE(is_lower_ground(plane(0.31, 0.09), 20));
  EXPECT_FALSE(is_lower_ground(plane(0.49, 0), 20));  // of one beam
  EXPECT_TRUE(is_lower_ground(plane(0.51, 0), 20));
}

TEST(LowerPlane, IsThin) {
  EXPECT_TRUE(is_lower_ground(plane(1, 0.5, 0.049), 20));
  EXPECT_FALSE(is_lower_ground(plane(1, 0.5, 0.051), 20));
}

TEST(LowerPlane, HasASlopeOfAtMost50Degrees) {
  Plane steep = plane();
  steep.normal = {0.766, 0, 0.643};
  EXPECT_TRUE(is_lower_ground(steep, 20));
  steep.normal = {0.771, 0, 0.637};
  EXPECT_FALSE(is_lower_ground(steep, 20));
}

TEST(LowerPlane, HeightAboveIsSignedAndInMetres) {
  EXPECT_DOUBLE_EQ(height_above(plane(), {8, 1, -2.5}), 0.5);
  EXPECT_DOUBLE_EQ(height_above(plane(), {0, 0, -3.25}), -0.25);
}

}  // namespace
}  // namespace flagstone::plane_fits
