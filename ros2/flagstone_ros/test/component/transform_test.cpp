// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "transform.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace flagstone_ros {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::FloatNear;

constexpr double half = 0.70710678118654752;  // cos(45 degrees)

auto is_near(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, 1e-12), DoubleNear(y, 1e-12), DoubleNear(z, 1e-12));
}

/// 90 degrees about z, then 1, 2, 3 m.
Transform turned_left() { return *transform_of({1, 2, 3}, {0, 0, half, half}); }

TEST(Transform, RotatesAndThenMoves) {
  std::vector<float> moved;
  const std::vector<float> point = {10, 0, 5};

  transform_points(turned_left(), 1, flagstone::CloudView(point.data(), 1), moved);

  EXPECT_THAT(moved, ElementsAre(FloatNear(1, 1e-6f), FloatNear(12, 1e-6f), FloatNear(8, 1e-6f)));
}

TEST(Transform, AcceptsQuaternionsOfAnyLength) {
  EXPECT_THAT(rotate(*transform_of({}, {0, 0, 5, 5}), {1, 0, 0}), is_near(0, 1, 0));
}

TEST(Transform, RejectsAQuaternionOfZeroAndValuesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(transform_of({}, {0, 0, 0, 0}));
  EXPECT_FALSE(transform_of({}, {0, nan, 0, 1}));
  EXPECT_FALSE(transform_of({0, nan, 0}, {0, 0, 0, 1}));
}

TEST(Transform, TimesItsInverseIsTheIdentity) {
  const Transform both = inverse(turned_left()) * turned_left();

  EXPECT_THAT(rotate(both, {1, 2, 3}), is_near(1, 2, 3));
  EXPECT_THAT(both.translation, is_near(0, 0, 0));
}

TEST(Transform, KeepsMissingReturnsAndPointsThatAreNotFinite) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> points = {0, 0, 0, infinity, 1, 2};
  std::vector<float> moved;

  transform_points(turned_left(), 1, flagstone::CloudView(points.data(), 2), moved);

  EXPECT_EQ(moved, points);
}

TEST(Transform, MovesCloudsInMillimetresByMetres) {
  const std::vector<float> point = {10000, 0, 0};
  std::vector<float> moved;

  transform_points({.translation = {1, 0, 0}}, 0.001, flagstone::CloudView(point.data(), 1), moved);

  EXPECT_FLOAT_EQ(moved[0], 11000);
}

TEST(Levelling, IsTheShortestRotationOfUpToZ) {
  const double angle = 0.3;
  const Vector up = {0, 9.81 * std::sin(angle), 9.81 * std::cos(angle)};

  const Transform level = levelling(up);

  EXPECT_THAT(rotate(level, up), is_near(0, 0, 9.81));
  EXPECT_THAT(rotate(level, {1, 0, 0}), is_near(1, 0, 0));
}

TEST(Levelling, TurnsASensorThatIsUpsideDown) {
  EXPECT_THAT(rotate(levelling({0, 0, -1}), {0, 0, -1}), is_near(0, 0, 1));
}

}  // namespace
}  // namespace flagstone_ros
