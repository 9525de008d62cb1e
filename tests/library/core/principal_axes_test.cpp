// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "library/core/plane.hpp"

namespace flagstone {
namespace {

Eigen::Matrix3d matrix(const Symmetric3& c) {
  Eigen::Matrix3d m;
  m << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  return m;
}

/// A covariance with three given variances along random orthogonal directions.
Symmetric3 any_covariance(double v1, double v2, double v3) {
  Eigen::Vector4d q;
  for (int i = 0; i < 4; ++i) q[i] = *rc::gen::inRange(-1000, 1001) + 0.5;
  const Eigen::Matrix3d r = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().matrix();
  const Eigen::Matrix3d m = r * Eigen::Vector3d(v1, v2, v3).asDiagonal() * r.transpose();
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)};
}

TEST(PrincipalAxes, MatchEigenOnAnyCovariance) {
  EXPECT_TRUE(rc::check([] {
    const double v1 = *rc::gen::inRange(1, 100000) / 1000.0;
    const double v2 = v1 * *rc::gen::inRange(1, 1000) / 1000.0;
    const double v3 = v2 * *rc::gen::inRange(0, 900) / 1000.0;
    const Symmetric3 covariance = any_covariance(v1, v2, v3);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix(covariance));

    const PrincipalAxes axes = principal_axes(covariance);

    const Eigen::Vector3d normal(axes.normal[0], axes.normal[1], axes.normal[2]);
    RC_ASSERT(std::abs(normal.norm() - 1) < 1e-12);
    RC_ASSERT(normal.z() >= 0);
    for (int i = 0; i < 3; ++i) {
      RC_ASSERT(std::abs(axes.eigenvalues[static_cast<std::size_t>(i)] -
                         eigen.eigenvalues()[2 - i]) < 1e-7 * v1);
    }
    RC_ASSERT(std::abs(normal.dot(eigen.eigenvectors().col(0))) > 1 - 1e-9);
  }));
}

TEST(PrincipalAxes, OfASinglePositionAreAHorizontalPlane) {
  const PrincipalAxes axes = principal_axes({0, 0, 0, 0, 0, 0});

  EXPECT_EQ(axes.normal, (Vector3{0, 0, 1}));
  EXPECT_EQ(axes.eigenvalues, (Vector3{0, 0, 0}));
}

TEST(PrincipalAxes, OfAHorizontalLineAreAHorizontalPlane) {
  const PrincipalAxes axes = principal_axes({4, 2, 0, 1, 0, 0});  // along (2, 1, 0)

  EXPECT_NEAR(axes.normal[2], 1, 1e-9);
  EXPECT_NEAR(axes.eigenvalues[0], 5, 1e-9);
}

TEST(PrincipalAxes, OfASlopedLineAreTiltedNoMoreThanTheLine) {
  const PrincipalAxes axes = principal_axes({1, 0, 1, 0, 0, 1});  // along (1, 0, 1)

  EXPECT_NEAR(axes.normal[0], -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(axes.normal[1], 0, 1e-6);
  EXPECT_NEAR(axes.normal[2], std::sqrt(0.5), 1e-6);
}

TEST(PrincipalAxes, OfAVerticalLineHaveAHorizontalNormal) {
  const PrincipalAxes axes = principal_axes({0, 0, 0, 0, 0, 3});

  EXPECT_NEAR(axes.normal[2], 0, 1e-9);
}

TEST(PrincipalAxes, OfThreePointsWithTwoEqualAreThePlaneOfTheLine) {
  // Determinant and minors consist only of rounding errors.
  const Vector3 a = {-1.8951, 0.0392, 0.14172};
  Moments moments;
  moments.add(0, 0, 0);
  moments.add(a[0], a[1], a[2]);
  moments.add(0, 0, 0);

  const PrincipalAxes axes = principal_axes(moments.covariance());

  EXPECT_NEAR(axes.eigenvalues[1], 0, 1e-9);
  EXPECT_NEAR(axes.normal[0] * a[0] + axes.normal[1] * a[1] + axes.normal[2] * a[2], 0, 1e-9);
  EXPECT_GT(axes.normal[2], 0.99);
}

TEST(PrincipalAxes, OfOverflowedCovariancesAreStillAPlane) {
  constexpr double inf = std::numeric_limits<double>::infinity();

  EXPECT_EQ(principal_axes({inf, 0, 0, 1, 0, 1}).normal, (Vector3{0, 0, 1}));
}

TEST(PrincipalAxes, OfAVerticalPlaneFaceTheSameWayDespiteRounding) {
  const Symmetric3 wall = {4, -4, 0, 4, 0, 2};  // along (1, -1, 0) and z
  const double tilt = 1e-8;                     // possible effect of rounding
  for (const double sign : {-1.0, 0.0, 1.0}) {
    Symmetric3 covariance = wall;
    covariance[2] = covariance[4] = sign * tilt;

    const PrincipalAxes axes = principal_axes(covariance);

    EXPECT_NEAR(axes.normal[0], std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(axes.normal[1], std::sqrt(0.5), 1e-6);
    EXPECT_EQ(axes.normal[2], 0);
  }
}

}  // namespace
}  // namespace flagstone
