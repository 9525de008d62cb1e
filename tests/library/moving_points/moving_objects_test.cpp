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
  Points& add(float x, float y, Evidence evidence, int count = 8) {
    const std::uint32_t column = MovingObjects::grid.column_at(x, y);
    for (int k = 0; k < count; ++k) {
      columns_.push_back(column);
      samples_.push_back({.column = column, .evidence = evidence});
    }
    return *this;
  }
  [[nodiscard]] MovingObjects find() const {
    MovingObjects objects;
    objects.start(columns_);
    objects.find(samples_);
    return objects;
  }

 private:
  std::vector<std::uint32_t> columns_;
  std::vector<MovingObjects::Sample> samples_;
};

std::uint32_t object_at(const MovingObjects& objects, float x, float y) {
  return objects.object_in(MovingObjects::grid.column_at(x, y));
}

TEST(MovingObjects, AWholeObjectMovesIfMostOfItsPointsMove) {
  const MovingObjects objects = Points()
                                    .add(10, 0, Evidence::moving, 20)
                                    .add(10.4F, 0, Evidence::none)
                                    .add(10.8F, 0.4F, Evidence::fixed, 5)
                                    .add(11.2F, 0.4F, Evidence::fixed, 5)
                                    .find();
  EXPECT_EQ(objects.count(), 1U);
  EXPECT_EQ(object_at(objects, 10, 0), 1U);
  EXPECT_EQ(object_at(objects, 11.2F, 0.4F), 1U);
}

TEST(MovingObjects, APersonNextToAWallMovesWithoutTheWall) {
  Points points;
  for (int k = -20; k <= 20; ++k) points.add(0.4F * static_cast<float>(k), 5, Evidence::fixed, 30);
  points.add(0, 4.6F, Evidence::moving, 20);
  const MovingObjects objects = points.find();
  EXPECT_EQ(object_at(objects, 0, 4.6F), 1U);
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
  const std::uint32_t column = MovingObjects::grid.column_at(3, 3);
  const std::vector<std::uint32_t> columns(10, column);
  objects.start(columns);
  objects.find(std::vector(10, MovingObjects::Sample{column, Evidence::moving}));
  EXPECT_EQ(objects.count(), 1U);
  objects.start(columns);
  objects.find(std::vector(10, MovingObjects::Sample{column, Evidence::fixed}));
  EXPECT_EQ(objects.count(), 0U);
  EXPECT_EQ(object_at(objects, 3, 3), 0U);
}

TEST(MovingObjects, ASampleSpeaksForTheOtherPointsOfADenseColumn) {
  MovingObjects objects;
  const std::uint32_t column = MovingObjects::grid.column_at(3, 3);
  objects.start(std::vector<std::uint32_t>(320, column));
  EXPECT_EQ(objects.points_per_sample(column), 10U);
  objects.find(std::vector{MovingObjects::Sample{column, Evidence::moving}});
  EXPECT_EQ(objects.count(), 1U);  // as with 10 points
}

TEST(MovingObjects, EachPointOfASparseColumnIsASample) {
  MovingObjects objects;
  const std::uint32_t column = MovingObjects::grid.column_at(3, 3);
  objects.start(std::vector<std::uint32_t>(32, column));
  EXPECT_EQ(objects.points_per_sample(column), 1U);
}

}  // namespace
}  // namespace flagstone
