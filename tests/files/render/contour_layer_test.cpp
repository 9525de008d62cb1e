// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "files/render/contours.hpp"

namespace flagstone::render {
namespace {

TEST(SuitableStep, IncreasesWithTheSpanOfHeights) {
  EXPECT_EQ(suitable_step(0).height, 0.25);
  EXPECT_EQ(suitable_step(3.5).height, 0.25);
  EXPECT_EQ(suitable_step(3.6).height, 0.5);
  EXPECT_EQ(suitable_step(8).height, 1);
  EXPECT_EQ(suitable_step(20).height, 2);
  EXPECT_EQ(suitable_step(60).height, 5);
  EXPECT_EQ(suitable_step(5000).height, 500);
  EXPECT_EQ(suitable_step(1e9).height, 1000);
}

TEST(HeightText, HasAsManyDecimalsAsTheStepNeeds) {
  EXPECT_EQ(height_text(1.75, suitable_step(1)), "1.75");
  EXPECT_EQ(height_text(2.5, suitable_step(5)), "2.5");
  EXPECT_EQ(height_text(12, suitable_step(12)), "12");
}

TEST(HeightText, HasATrueMinusSignAndNoneForZero) {
  EXPECT_EQ(height_text(-1.5, suitable_step(1)), "\u22121.50");
  EXPECT_EQ(height_text(-0.0, suitable_step(1)), "0.00");
}

}  // namespace
}  // namespace flagstone::render
