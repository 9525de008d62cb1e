// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/coarse_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/owned_grid.hpp"

namespace flagstone::surface {
namespace {

using tests::OwnedGrid;

constexpr float sensor_height = 1.73f;

/// A plane at (x, y) with many points and no residuals.
Plane plane_at(double x, double y, double z, double slope_x = 0, double slope_y = 0) {
  const double length = std::hypot(slope_x, slope_y, 1.0);
  return {.count = 100,
          .mean = {x, y, z},
          .normal = {-slope_x / length, -slope_y / length, 1 / length},
          .d = (slope_x * x + slope_y * y - z) / length,
          .eigenvalues = {1, 1, 0}};
}

/// A surface within 32 m of the sensor. The parameter is the instruction set.
class CoarseSurfaceOn : public testing::TestWithParam<std::string> {
 protected:
  CoarseSurfaceOn() { surface_.clear(); }

  void finish() {
    PullPush pull_push(grid_.grid().width);
    surface_.finish(pull_push);
  }

  /// Height and confidence of the cell at (x, y).
  float height(float x, float y) { return grid_.heights()[cell(x, y)]; }
  float confidence(float x, float y) { return grid_.confidences()[cell(x, y)]; }

  std::size_t cell(float x, float y) {
    const auto index = [](float v) { return static_cast<std::size_t>((v + 32) / 2); };
    return index(y) * grid_.grid().width + index(x);
  }

  tests::ForcedTarget forced_{GetParam()};
  OwnedGrid grid_{2, 32, 55, 55};  // initial values must not matter
  CoarseSurface surface_{grid_.grid(), sensor_height};
};

INSTANTIATE_TEST_SUITE_P(Target, CoarseSurfaceOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(CoarseSurfaceOn, ReproducesAPlaneCoveredByPatches) {
  const auto ground = [](double x, double y) { return -1.73 + 0.1 * x - 0.2 * y; };
  for (double y = -30; y <= 30; y += 4) {
    for (double x = -30; x <= 30; x += 4) surface_.add(plane_at(x, y, ground(x, y), 0.1, -0.2), 4);
  }

  finish();

  for (float y = -31; y <= 31; y += 2) {
    for (float x = -31; x <= 31; x += 2) {
      // The expected height below the sensor has some weight in the four cells around it.
      const float tolerance = std::hypot(x, y) < 3 ? 0.06f : 1e-5f;
      EXPECT_NEAR(height(x, y), ground(static_cast<double>(x), static_cast<double>(y)), tolerance);
      EXPECT_EQ(confidence(x, y), 1);
    }
  }
}

TEST_P(CoarseSurfaceOn, WithoutPatchesGroundIsAtTheSensorHeightWithZeroConfidence) {
  finish();

  EXPECT_NEAR(height(1, 1), -sensor_height, 1e-6f);
  EXPECT_NEAR(height(31, -31), -sensor_height, 1e-6f);
  EXPECT_EQ(confidence(1, 1), 0);
  EXPECT_EQ(confidence(31, -31), 0);
}

TEST_P(CoarseSurfaceOn, ConfidenceDecreasesWithTheDistanceFromAPatch) {
  surface_.add(plane_at(11, 11, -1), 4);

  finish();

  EXPECT_NEAR(height(11, 11), -1, 1e-5f);
  EXPECT_EQ(confidence(11, 11), 1);
  EXPECT_LT(confidence(-31, -31), confidence(21, 21));
  EXPECT_LT(confidence(21, 21), 1);
}

TEST_P(CoarseSurfaceOn, HeightsBetweenTwoPatchesLieBetweenTheirHeights) {
  surface_.add(plane_at(-21, 21, -2), 4);
  surface_.add(plane_at(21, 21, -1), 4);

  finish();

  EXPECT_NEAR(height(-21, 21), -2, 1e-4f);
  EXPECT_NEAR(height(21, 21), -1, 1e-4f);
  for (float x = -19; x <= 19; x += 2) {
    EXPECT_GT(height(x, 21), -2.001f);
    EXPECT_LT(height(x, 21), -0.999f);
  }
}

TEST_P(CoarseSurfaceOn, CloserAndFlatterPatchesHaveMoreWeight) {
  surface_.add(plane_at(9, 9, -1), 4);
  surface_.add(plane_at(13, 9, 0), 4);
  Plane rough = plane_at(-11, 9, 0);
  rough.eigenvalues[2] = 0.09;  // standard deviation 0.3 m
  surface_.add(rough, 4);
  surface_.add(plane_at(-11, 9, -1), 4);

  finish();

  EXPECT_LT(height(9, 9), -0.5f);
  EXPECT_GT(height(13, 9), -0.5f);
  EXPECT_LT(height(-11, 9), -0.9f);
}

TEST_P(CoarseSurfaceOn, PatchesAtTheEdgeStayWithinTheGrid) {
  for (const double x : {-31.9, 31.9}) {
    for (const double y : {-31.9, 31.9}) surface_.add(plane_at(x, y, -3), 8);
  }

  finish();

  EXPECT_NEAR(height(31, 31), -3, 1e-5f);
  EXPECT_NEAR(height(-31, 31), -3, 1e-5f);
}

}  // namespace
}  // namespace flagstone::surface
