// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/occupied_columns.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace flagstone {
namespace {

void add(OccupiedColumns& columns, std::uint32_t column, bool is_object) {
  columns.add(std::array{2 * column + (is_object ? 1U : 0U)});
}

void add_scans(OccupiedColumns& columns, int count, bool is_object) {
  for (int k = 0; k < count; ++k) {
    columns.start(1, -10);
    const std::uint32_t column = columns.grid().column_at(2.2F, 2.9F);
    add(columns, column, false);  // the ground below an object
    if (is_object) add(columns, column, true);
    columns.finish();
  }
}

// The column at (dx, dy) metres from the position of look_around().
bool is_occupied_near(const OccupiedColumns& columns, double dx, double dy) {
  return columns.is_occupied(
      columns.surroundings().column_at(static_cast<float>(dx), static_cast<float>(dy)));
}

bool is_occupied(OccupiedColumns& columns, double x, double y) {
  columns.look_around(-20, 30);
  return is_occupied_near(columns, x + 20, y - 30);
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
    EXPECT_TRUE(is_occupied_near(columns, 3.2 - x, -7.1 - x));
    EXPECT_FALSE(is_occupied_near(columns, 3.6 - x, -7.1 - x));
  }
}

TEST(OccupiedColumns, PointsOutsideAreNotCounted) {
  OccupiedColumns columns;
  for (int k = 0; k < 4; ++k) {
    columns.start(0, 0);
    add(columns, columns.grid().column_at(60, 0), true);
    columns.finish();
  }
  columns.look_around(0, 0);
  for (const double x : {-200.0, -101.0, 0.0, 60.0, 101.0, 200.0}) {
    EXPECT_FALSE(is_occupied_near(columns, x, 0));
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
