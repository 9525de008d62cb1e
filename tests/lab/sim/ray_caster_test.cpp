// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ray_caster.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace flagstone::sim {
namespace {

constexpr Surface wall{.semantic = SemanticClass::building, .reflectivity = 0.5F};
constexpr double far = 100;
constexpr RayCaster::Hit miss{.range = -1, .triangle = ~0U, .incidence = -1};

// The triangle (10, -1, -1), (10, 1, -1), (10, 0, 2): upright, 10 m ahead.
Mesh triangle_ahead() {
  Mesh mesh;
  mesh.add_triangle({10, -1, -1}, {10, 1, -1}, {10, 0, 2}, wall);
  return mesh;
}

TEST(RayCaster, HitsATriangleAtItsDistance) {
  const RayCaster caster(triangle_ahead());

  const RayCaster::Hit hit = caster.cast({0, 0, 0}, {1, 0, 0}, 0, far).value_or(miss);

  EXPECT_EQ(hit.triangle, 0U);
  EXPECT_NEAR(hit.range, 10, 1e-12);
  EXPECT_NEAR(hit.incidence, 1, 1e-12);
}

TEST(RayCaster, MeasuresAlongAnObliqueBeam) {
  const RayCaster caster(triangle_ahead());

  const RayCaster::Hit hit = caster.cast({0, -10, 0}, normalized({1, 1, 0}), 0, far).value_or(miss);

  EXPECT_NEAR(hit.range, 10 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(hit.incidence, std::sqrt(0.5), 1e-9);
}

TEST(RayCaster, HitsBothSidesOfATriangle) {
  const RayCaster caster(triangle_ahead());

  EXPECT_TRUE(caster.cast({20, 0, 0}, {-1, 0, 0}, 0, far));
}

TEST(RayCaster, MissesATriangleNextToTheBeam) {
  const RayCaster caster(triangle_ahead());

  EXPECT_FALSE(caster.cast({0, 1.1, 0}, {1, 0, 0}, 0, far));
}

TEST(RayCaster, HitsOnlyBetweenNearAndFar) {
  const RayCaster caster(triangle_ahead());

  EXPECT_FALSE(caster.cast({0, 0, 0}, {1, 0, 0}, 0, 9.9));
  EXPECT_FALSE(caster.cast({0, 0, 0}, {1, 0, 0}, 10.1, far));
}

TEST(RayCaster, ReturnsTheNearestOfSeveral) {
  Mesh mesh = triangle_ahead();
  mesh.add_triangle({7, -1, -1}, {7, 1, -1}, {7, 0, 2}, wall);
  const RayCaster caster(std::move(mesh));

  const RayCaster::Hit hit = caster.cast({0, 0, 0}, {1, 0, 0}, 0, far).value_or(miss);

  EXPECT_EQ(hit.triangle, 1U);
}

TEST(RayCaster, HitsNothingInAnEmptyMesh) {
  const RayCaster caster{Mesh{}};

  EXPECT_FALSE(caster.cast({0, 0, 0}, {1, 0, 0}, 0, far));
}

TEST(RayCaster, RejectsATriangleWithAMissingVertex) {
  Mesh mesh = triangle_ahead();
  mesh.add_triangle(Mesh::Triangle{0, 1, 3}, wall);

  EXPECT_THROW(RayCaster{std::move(mesh)}, std::invalid_argument);
}

}  // namespace
}  // namespace flagstone::sim
