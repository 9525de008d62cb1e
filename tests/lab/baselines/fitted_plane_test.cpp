// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/baselines/fitted_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flagstone::baselines {
namespace {

/// Nine points on z = 0.5 x - 3, and one point far above them.
struct SlopeAndOnePointAbove {
  SlopeAndOnePointAbove() {
    for (int i = 0; i < 9; ++i) {
      x.push_back(static_cast<float>(i / 3));
      y.push_back(static_cast<float>(i % 3));
      z.push_back(0.5f * x.back() - 3);
    }
    x.push_back(1);
    y.push_back(1);
    z.push_back(50);
  }

  [[nodiscard]] Plane fit() const {
    return fit_plane({x, y, z}, [](float, float, float height) { return height < 0; });
  }

  std::vector<float> x, y, z;
};

TEST(Plane, FitsThePointsOfItsSetWithAnUpwardNormal) {
  const Plane fit = SlopeAndOnePointAbove().fit();

  ASSERT_TRUE(fit.exists());
  EXPECT_EQ(fit.count, 9);
  EXPECT_NEAR(fit.normal[0], -0.5 / std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(fit.normal[1], 0, 1e-12);
  EXPECT_NEAR(fit.normal[2], 1 / std::sqrt(1.25), 1e-12);
  EXPECT_NEAR(fit.mean[2], -2.5, 1e-12);
}

TEST(Plane, DistanceIsPositiveAboveThePlane) {
  const SinglePrecisionPlane plane = single_precision(SlopeAndOnePointAbove().fit());

  EXPECT_NEAR(plane.distance(0, 0, -3), 0, 1e-6f);
  EXPECT_NEAR(plane.distance(4, 7, 1), 2 / std::sqrt(1.25f), 1e-6f);
  EXPECT_LT(plane.distance(0, 0, -4), 0);
}

TEST(Plane, NeedsThreePoints) {
  const std::vector<float> x = {1, 2, 3};

  EXPECT_FALSE(fit_plane({x, x, x}, [](float at, float, float) { return at > 1; }).exists());
  EXPECT_TRUE(fit_plane({x, x, x}, [](float, float, float) { return true; }).exists());
}

TEST(Plane, MakesAGroundPatch) {
  Patch patch;

  set_ground_plane(SlopeAndOnePointAbove().fit(), patch);

  EXPECT_EQ(patch.verdict, Verdict::ground);
  EXPECT_FLOAT_EQ(patch.d, static_cast<float>(3 / std::sqrt(1.25)));
  EXPECT_NEAR(patch.surface_variable, 0, 1e-12f);
}

}  // namespace
}  // namespace flagstone::baselines
