// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "lab/sim/ray_caster.hpp"
#include "lab/sim/street_shape.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface road{.semantic = SemanticClass::road, .reflectivity = 0.2F};
constexpr Surface lawn{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};

// Two cells along x, 1 m each, bent to the left by 0.5 m a metre; the far one is lawn.
Ground bent_ground() {
  return {{.x = {0, 1, 2}, .offset = {0, 0.5, 1}, .t = {0, 2}}, {0, 0, 1, 1, 4, 4}, {road, lawn}};
}

TEST(Ground, InterpolatesBetweenItsLines) {
  const Ground ground = bent_ground();

  EXPECT_DOUBLE_EQ(ground.height(0.5, 1), 0.5);
  EXPECT_DOUBLE_EQ(ground.height(1.5, 1), 2.5);
}

TEST(Ground, KnowsWhatLiesWhere) {
  const Ground ground = bent_ground();

  EXPECT_EQ(ground.surface(0.5, 1).semantic, SemanticClass::road);
  EXPECT_EQ(ground.surface(1.5, 1).semantic, SemanticClass::terrain);
}

TEST(Ground, CoversItsBentOutlineOnly) {
  const Ground ground = bent_ground();

  EXPECT_TRUE(ground.covers(2, 2.9));
  EXPECT_FALSE(ground.covers(2, 0.9));
  EXPECT_FALSE(ground.covers(2.1, 2));
}

TEST(Ground, RefusesLinesThatDoNotAscend) {
  EXPECT_THROW(Ground({.x = {0, 0}, .offset = {0, 0}, .t = {0, 1}}, {0, 0, 0, 0}, {road}),
               std::invalid_argument);
}

TEST(Ground, RefusesAMissingHeight) {
  EXPECT_THROW(Ground({.x = {0, 1}, .offset = {0, 0}, .t = {0, 1}}, {0, 0, 0}, {road}),
               std::invalid_argument);
}

// A street with everything that bends its ground.
StreetShape hilly_street() {
  StreetShape shape;
  shape.half_length = 40;
  shape.grade = 0.03;
  shape.grade_changes = {{.change = -0.06, .x = 15}};
  shape.bend_amplitude = 3;
  shape.cross_fall = 0.02;
  shape.sides[0].parking_width = 2.2;
  shape.sides[0].bank_height = 0.8;
  shape.sides[1].driveways = {{.x = 3.3, .width = 2.6}};
  shape.undulations = {{.amplitude = 0.1, .wave_x = 0.5, .wave_y = 0.4, .phase = 1}};
  return shape;
}

TEST(Ground, ItsMeshHasTheHeightsItTells) {
  const Ground ground = make_ground(hilly_street());
  Mesh mesh;
  ground.add_to(mesh);
  const RayCaster caster(std::move(mesh));
  constexpr RayCaster::Hit miss{.range = -1, .triangle = ~0U, .incidence = -1};
  constexpr double above = 50;

  for (int i = -100; i < 100; ++i) {
    for (int j = -160; j < 160; ++j) {
      const double x = 0.37 * i;
      const double y = 0.113 * j;
      const RayCaster::Hit hit = caster.cast({x, y, above}, {0, 0, -1}, 0, 100).value_or(miss);
      ASSERT_NEAR(above - hit.range, ground.height(x, y), 1e-4) << "at " << x << ", " << y;
    }
  }
}

TEST(Street, RoadIsHighestInTheMiddle) {
  const StreetShape shape;

  EXPECT_NEAR(shape.height(0, 0) - shape.height(0, 3.2), shape.crown, 1e-12);
  EXPECT_NEAR(shape.height(0, 0) - shape.height(0, -3.2), shape.crown, 1e-12);
}

TEST(Street, KerbStepsUpToTheSidewalk) {
  const StreetShape shape;
  const double kerb = shape.kerb(Side::left);

  const double step = shape.height(0, shape.sidewalk_begin(Side::left)) - shape.height(0, kerb);

  EXPECT_NEAR(step, shape.side(Side::left).kerb_height, 1e-9);
  EXPECT_EQ(shape.surface(0, kerb - 0.01).semantic, SemanticClass::road);
  EXPECT_EQ(shape.surface(0, kerb + 0.01).semantic, SemanticClass::sidewalk) << "the kerb's face";
}

TEST(Street, KerbIsLowAtADriveway) {
  const StreetShape shape = hilly_street();
  const double kerb = shape.kerb(Side::left);
  const auto step = [&](double x) {
    return shape.height(x, shape.sidewalk_begin(Side::left)) - shape.height(x, kerb);
  };

  EXPECT_LT(step(3.3), 0.05);
  EXPECT_GT(step(10), 0.1);
}

TEST(Street, GradeChangesSmoothlyAhead) {
  const StreetShape shape = hilly_street();
  const auto grade = [&](double x) {
    return (shape.height(x + 0.5, 0) - shape.height(x - 0.5, 0));
  };

  EXPECT_NEAR(grade(-30), 0.03, 0.001);
  EXPECT_NEAR(grade(15), 0, 0.001);
  for (int x = -38; x < 38; ++x) EXPECT_LT(std::abs(grade(x + 1) - grade(x)), 0.003);
}

TEST(Street, GradesFollowOneAnotherInAnyNumber) {
  StreetShape shape;
  shape.grade = 0.2;
  shape.grade_changes = {{.change = -0.35, .x = -50, .length = 6}, {.change = 0.3, .x = 40}};
  const auto grade = [&](double x) {
    return (shape.height(x + 0.5, 0) - shape.height(x - 0.5, 0));
  };

  EXPECT_NEAR(grade(-100), 0.2, 0.001);
  EXPECT_NEAR(grade(-5), -0.15, 0.002);
  EXPECT_NEAR(grade(100), 0.15, 0.001);
  EXPECT_EQ(shape.height(0, 0), 0);
}

}  // namespace
}  // namespace flagstone::sim
