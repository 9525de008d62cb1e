// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "files/render/text.hpp"

namespace flagstone::render {
namespace {

TEST(NumberText, SeparatesThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(124668), "124,668");
  EXPECT_EQ(grouped(10000000), "10,000,000");
}

TEST(NumberText, FormatsPercentagesWithOneDecimal) {
  EXPECT_EQ(percent(1, 3), "33.3 %");
  EXPECT_EQ(percent(7, 7), "100.0 %");
}

TEST(NumberText, DistinguishesSmallValuesFromZero) {
  EXPECT_EQ(percent(0, 1000000), "0.0 %");
  EXPECT_EQ(percent(1, 1000000), "<0.1 %");
}

TEST(NumberText, FormatsAFractionOfNothingAsZero) { EXPECT_EQ(percent(0, 0), "0.0 %"); }

}  // namespace
}  // namespace flagstone::render
