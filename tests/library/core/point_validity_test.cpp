// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/point_validity.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "numbers.hpp"

namespace flagstone {
namespace {

constexpr float denormal = std::numeric_limits<float>::denorm_min();

TEST(PointValidity, RequiresThreeFiniteCoordinates) {
  EXPECT_TRUE(is_valid({1, -2, 3}));
  for (const float bad : {inf, -inf, nan}) {
    EXPECT_FALSE(is_valid({bad, 2, 3})) << bad;
    EXPECT_FALSE(is_valid({1, bad, 3})) << bad;
    EXPECT_FALSE(is_valid({1, 2, bad})) << bad;
  }
}

TEST(PointValidity, ExcludesTheAllZeroPointWithAnySigns) {
  EXPECT_FALSE(is_valid({0, 0, 0}));
  EXPECT_FALSE(is_valid({-0.0f, 0, -0.0f}));
  EXPECT_TRUE(is_valid({0, 0, denormal}));
  EXPECT_TRUE(is_valid({0, 0, -1}));
}

TEST(PointValidity, LimitsEachCoordinateToTenKilometres) {
  EXPECT_TRUE(is_within_limit({max_coordinate, -max_coordinate, max_coordinate}));
  for (const float far : {10000.001f, -10000.001f}) {
    EXPECT_FALSE(is_within_limit({far, 0, 0}));
    EXPECT_FALSE(is_within_limit({0, far, 0}));
    EXPECT_FALSE(is_within_limit({0, 0, far}));
  }
}

}  // namespace
}  // namespace flagstone
