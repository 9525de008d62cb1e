// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

namespace flagstone {
namespace {

Quaternion random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return {normal(random), normal(random), normal(random), normal(random)};
}

void expect_equal(const RotationMatrix& a, const RotationMatrix& b, double tolerance) {
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(Rotation, OfAQuaternionTurnsCounterClockwiseAboutItsAxis) {
  const RotationMatrix quarter = matrix_of({.z = 1, .w = 1});

  expect_equal(quarter, {0, -1, 0, 1, 0, 0, 0, 0, 1}, 1e-15);
}

TEST(Rotation, MatricesAndQuaternionsConvertBothWays) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const RotationMatrix r = matrix_of(random_rotation(random));
    expect_equal(matrix_of(quaternion_of(r)), r, 1e-14);
  }
  for (const RotationMatrix& half_turn :
       {RotationMatrix{1, 0, 0, 0, -1, 0, 0, 0, -1}, RotationMatrix{-1, 0, 0, 0, 1, 0, 0, 0, -1},
        RotationMatrix{-1, 0, 0, 0, -1, 0, 0, 0, 1}}) {
    expect_equal(matrix_of(quaternion_of(half_turn)), half_turn, 1e-15);
  }
}

TEST(Rotation, BetweenTurnsAtConstantSpeedAlongTheShorterWay) {
  const Quaternion from{.x = 0, .y = 0, .z = 0, .w = 1};
  for (const double angle : {1e-6, 0.1, 3.0}) {
    const double z = std::sin(angle / 2);
    const double w = std::cos(angle / 2);
    for (const double sign : {-1.0, 1.0}) {
      const Quaternion to{.x = 0, .y = 0, .z = sign * z, .w = sign * w};
      const auto turned = rotation_vector(matrix_of(between(from, to, 0.25)));

      EXPECT_NEAR(turned[2], 0.25 * angle, 1e-12) << angle;
    }
  }
}

TEST(Rotation, VectorHasTheAngleAsItsLength) {
  EXPECT_NEAR(rotation_vector(matrix_of({.x = 1, .w = 1}))[0], std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(rotation_vector(matrix_of({.x = 0, .y = 1, .z = 0, .w = 0}))[1], std::numbers::pi,
              1e-15);
  EXPECT_EQ(rotation_vector({1, 0, 0, 0, 1, 0, 0, 0, 1})[2], 0);
}

TEST(Rotation, NearestRotationIsARotation) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> error(-3e-4, 3e-4);
  for (int i = 0; i < 100; ++i) {
    const RotationMatrix exact = matrix_of(random_rotation(random));
    RotationMatrix rough = exact;
    for (double& value : rough) value += error(random);

    const RotationMatrix found = nearest_rotation(rough);

    expect_equal(product(transposed(found), found), {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1e-14);
    expect_equal(found, exact, 1e-3);
  }
}

}  // namespace
}  // namespace flagstone
