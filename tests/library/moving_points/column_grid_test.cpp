// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/column_grid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace flagstone {
namespace {

// 10 x 10 columns of 0.5 m; the sensor is 1.25 m from the left edge and 2 m from the lower one.
constexpr ColumnGrid square{.offset_x = 1.25F, .offset_y = 2, .per_metre = 2, .width = 10};

TEST(ColumnGrid, ColumnsAreNumberedRowByRow) {
  EXPECT_EQ(square.column_at(0, 0), 42U);
  EXPECT_EQ(square.column_at(0.3F, 0), 43U);
  EXPECT_EQ(square.column_at(0, 0.5F), 52U);
}

TEST(ColumnGrid, TheOutermostColumnsAreOutside) {
  EXPECT_EQ(square.column_at(-0.7F, 0), 41U);
  EXPECT_EQ(square.column_at(-0.8F, 0), square.outside());
  EXPECT_EQ(square.column_at(0, 2.4F), 82U);
  EXPECT_EQ(square.column_at(0, 2.5F), square.outside());
}

TEST(ColumnGrid, AnyNumberHasAnIndex) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float x : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 1e30F}) {
    EXPECT_EQ(square.column_at(x, 0), square.outside());
    EXPECT_EQ(square.column_at(0, x), square.outside());
  }
}

}  // namespace
}  // namespace flagstone
