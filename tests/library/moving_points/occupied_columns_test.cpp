// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/occupied_columns.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace flagstone {
namespace {

void add_scans(OccupiedColumns& columns, int count, bool is_object) {
  for (int k = 0; k < count; ++k) {
    columns.start(1, -10);
    const std::uint32_t column = columns.grid().column_at(2.2F, 2.9F);
    columns.add(column, false);  // the ground below an object
    if (is_object) columns.add(column, true);
    columns.finish();
  }
}

bool is_occupied(OccupiedColumns& columns, double x, double y) {
  columns.look_around(-20, 30);
  return columns.is_occupied(static_cast<float>(x + 20), static_cast<float>(y - 30));
}

TEST(OccupiedColumns, AnObjectInAllScansOccupiesItsColumn) {
  OccupiedColumns columns;
  add_scans(columns, 4, true);
  EXPECT_TRUE(is_occupied(columns, 3.2, -7.1));
  EXPECT_TRUE(is_occupied(columns, 3.4, -7.4));   // the same column of 0.5 m
  EXPECT_FALSE(is_occupied(columns, 3.6, -7.1));  // the next one
}

TEST(OccupiedColumns, FewScansAreNotEnough) {
  OccupiedColumns columns;
  add_scans(columns, 3, true);
  EXPECT_FALSE(is_occupied(columns, 3.2, -7.1));
}

TEST(OccupiedColumns, AColumnThatWasOftenEmptyIsNotOccupied) {
  OccupiedColumns columns;
  add_scans(columns, 18, true);
  add_scans(columns, 2, false);
  EXPECT_FALSE(is_occupied(columns, 3.2, -7.1));
  add_scans(columns, 1, true);
  EXPECT_TRUE(is_occupied(columns, 3.2, -7.1));
}

TEST(OccupiedColumns, OtherPositionsSeeTheSameColumns) {
  OccupiedColumns columns;
  add_scans(columns, 4, true);
  for (const double x : {-95.0, -40.3, 0.0, 17.7, 89.9}) {
    columns.look_around(x, x);
    EXPECT_TRUE(columns.is_occupied(static_cast<float>(3.2 - x), static_cast<float>(-7.1 - x)));
    EXPECT_FALSE(columns.is_occupied(static_cast<float>(3.6 - x), static_cast<float>(-7.1 - x)));
  }
}

TEST(OccupiedColumns, PointsOutsideAreNotCounted) {
  OccupiedColumns columns;
  for (int k = 0; k < 4; ++k) {
    columns.start(0, 0);
    columns.add(columns.grid().column_at(60, 0), true);
    columns.finish();
  }
  columns.look_around(0, 0);
  for (const float x : {-200.F, -101.F, 0.F, 60.F, 101.F, 200.F}) {
    EXPECT_FALSE(columns.is_occupied(x, 0));
  }
}

TEST(OccupiedColumns, DistantColumnsAreForgotten) {
  OccupiedColumns columns;
  add_scans(columns, 4, true);
  columns.forget_beyond(50, -7, 100);
  EXPECT_TRUE(is_occupied(columns, 3.2, -7.1));
  columns.forget_beyond(150, -7, 100);
  EXPECT_FALSE(is_occupied(columns, 3.2, -7.1));
}

}  // namespace
}  // namespace flagstone
