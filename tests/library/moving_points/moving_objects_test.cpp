// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/moving_objects.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace flagstone {
namespace {

using Evidence = MovingObjects::Evidence;

/// Points with evidence, by position.
class Points {
 public:
  Points& add(double x, double y, Evidence evidence, int count = 8) {
    for (int k = 0; k < count; ++k) {
      columns_.push_back(MovingObjects::column_of(x, y));
      evidence_.push_back(evidence);
    }
    return *this;
  }
  [[nodiscard]] MovingObjects find() const {
    MovingObjects objects;
    objects.find(columns_, evidence_);
    return objects;
  }

 private:
  std::vector<std::uint32_t> columns_;
  std::vector<Evidence> evidence_;
};

std::uint32_t object_at(const MovingObjects& objects, double x, double y) {
  return objects.object_in(MovingObjects::column_of(x, y));
}

TEST(MovingObjects, AWholeObjectMovesIfMostOfItsPointsMove) {
  const MovingObjects objects = Points()
                                    .add(10, 0, Evidence::moving, 20)
                                    .add(10.4, 0, Evidence::none)
                                    .add(10.8, 0.4, Evidence::fixed, 5)
                                    .add(11.2, 0.4, Evidence::fixed, 5)
                                    .find();
  EXPECT_EQ(objects.count(), 1U);
  EXPECT_EQ(object_at(objects, 10, 0), 1U);
  EXPECT_EQ(object_at(objects, 11.2, 0.4), 1U);
}

TEST(MovingObjects, APersonNextToAWallMovesWithoutTheWall) {
  Points points;
  for (int k = -20; k <= 20; ++k) points.add(0.4 * k, 5, Evidence::fixed, 30);
  points.add(0, 4.6, Evidence::moving, 20);
  const MovingObjects objects = points.find();
  EXPECT_EQ(object_at(objects, 0, 4.6), 1U);
  EXPECT_EQ(object_at(objects, 0, 5), 0U);
}

TEST(MovingObjects, FewMovingPointsAreNoise) {
  EXPECT_EQ(Points().add(10, 0, Evidence::moving, 7).find().count(), 0U);
  EXPECT_EQ(Points().add(10, 0, Evidence::moving, 8).find().count(), 1U);
}

TEST(MovingObjects, SeparateObjectsHaveDifferentNumbers) {
  const MovingObjects objects =
      Points().add(-10, 4, Evidence::moving).add(10, -4, Evidence::moving).find();
  EXPECT_EQ(objects.count(), 2U);
  EXPECT_EQ(object_at(objects, 10, -4), 1U);  // by rows of increasing y
  EXPECT_EQ(object_at(objects, -10, 4), 2U);
}

TEST(MovingObjects, AScanHasNoInfluenceOnTheNextOne) {
  MovingObjects objects;
  const std::vector<std::uint32_t> columns(10, MovingObjects::column_of(3, 3));
  objects.find(columns, std::vector<Evidence>(10, Evidence::moving));
  EXPECT_EQ(objects.count(), 1U);
  objects.find(columns, std::vector<Evidence>(10, Evidence::fixed));
  EXPECT_EQ(objects.count(), 0U);
  EXPECT_EQ(object_at(objects, 3, 3), 0U);
}

TEST(MovingObjects, ColumnsBeyond100MetresAreOutside) {
  EXPECT_NE(MovingObjects::column_of(-101, 101), MovingObjects::outside);
  EXPECT_EQ(MovingObjects::column_of(103, 0), MovingObjects::outside);
  EXPECT_EQ(MovingObjects::column_of(0, -1e12), MovingObjects::outside);
}

}  // namespace
}  // namespace flagstone
