// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/ray_caster.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/street_shape.hpp"
#include "library/core/random.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface road{.semantic = SemanticClass::road, .reflectivity = 0.2F};
constexpr Surface lawn{.semantic = SemanticClass::terrain, .reflectivity = 0.4F};

// Two cells along x, 1 m each, bent to the left by 0.5 m/m; the far cell is lawn.
Ground bent_ground() {
  return {{.x = {0, 1, 2}, .offset = {0, 0.5, 1}, .t = {0, 2}}, {0, 0, 1, 1, 4, 4}, {road, lawn}};
}

TEST(Ground, InterpolatesBetweenItsLines) {
  const Ground ground = bent_ground();

  EXPECT_DOUBLE_EQ(ground.height(0.5, 1), 0.5);
  EXPECT_DOUBLE_EQ(ground.height(1.5, 1), 2.5);
}

TEST(Ground, ReportsTheClassAtAPosition) {
  const Ground ground = bent_ground();

  EXPECT_EQ(ground.surface(0.5, 1).semantic, SemanticClass::road);
  EXPECT_EQ(ground.surface(1.5, 1).semantic, SemanticClass::terrain);
}

TEST(Ground, CoversOnlyItsBentOutline) {
  const Ground ground = bent_ground();

  EXPECT_TRUE(ground.covers(2, 2.9));
  EXPECT_FALSE(ground.covers(2, 0.9));
  EXPECT_FALSE(ground.covers(2.1, 2));
}

TEST(Ground, RejectsLinesThatDoNotAscend) {
  EXPECT_THROW(Ground({.x = {0, 0}, .offset = {0, 0}, .t = {0, 1}}, {0, 0, 0, 0}, {road}),
               std::invalid_argument);
}

TEST(Ground, RejectsAMissingHeight) {
  EXPECT_THROW(Ground({.x = {0, 1}, .offset = {0, 0}, .t = {0, 1}}, {0, 0, 0}, {road}),
               std::invalid_argument);
}

// A street with all parameters that bend its ground.
StreetShape hilly_street() {
  StreetShape shape;
  shape.length = {-40, 40};
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

TEST(Ground, MeshHasTheSameHeights) {
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

TEST(Street, AcceptsAnyNumberOfGrades) {
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

constexpr Surface soil{};
constexpr double face_width = 0.02;  // width of the face of a step, metres

// A step on a 20 m square: height 0 for negative y, 1 m behind a face that is tilted back by 2 cm.
Ground step_ground() {
  return {{.x = {-10, 10}, .offset = {0, 0}, .t = {-10, 0, face_width, 10}},
          {0, 0, 1, 1, 0, 0, 1, 1},
          {soil, soil, soil}};
}

// A slope of 0.1 m/m along x.
Ground slope_ground() {
  return {{.x = {-10, 10}, .offset = {0, 0}, .t = {-10, 10}}, {-1, -1, 1, 1}, {soil}};
}

TEST(FirstCrossing, VerticalRayHitsTheGroundBelow) {
  const Ground ground = step_ground();

  EXPECT_EQ(ground.first_crossing({1, -3, 5}, {0, 0, -1}), 5);
  EXPECT_EQ(ground.first_crossing({1, 3, 5}, {0, 0, -1}), 4);
  EXPECT_EQ(ground.first_crossing({1, 3, -2}, {0, 0, 1}), 3) << "from below";
  EXPECT_EQ(ground.first_crossing({1, 3, 5}, {0, 0, -2}), 2) << "in lengths of the direction";
}

TEST(FirstCrossing, IsZeroOnTheGroundItself) {
  EXPECT_EQ(step_ground().first_crossing({1, 3, 1}, {0, 0, -1}), 0);
  EXPECT_EQ(step_ground().first_crossing({1, 3, 1}, {0, 0, 1}), 0);
}

TEST(FirstCrossing, IsTheNearestOfSeveral) {
  // The line is tilted by 0.1 m/m and the face by 0.02 m/m, so the line leaves the upper level
  // through the face.
  const Ground ground = step_ground();
  const Vector3 leaning{0, -0.1, -1};

  EXPECT_NEAR(ground.first_crossing({0, 0.2205, 3}, leaning).value(), 2, 1e-12);
  EXPECT_NEAR(ground.first_crossing({0, 0.2195, 3}, leaning).value(), 3, 1e-12) << "past the face";
  EXPECT_NEAR(ground.first_crossing({0, -0.05, 0.5}, {0, 0.5, -0.1}).value(), 3 / 25.1, 1e-12)
      << "the face itself";
}

TEST(FirstCrossing, IsEmptyOffTheGridAndForRaysThatLeaveIt) {
  const Ground ground = step_ground();

  EXPECT_EQ(ground.first_crossing({11, 0, 5}, {0, 0, -1}), std::nullopt);
  EXPECT_EQ(ground.first_crossing({9, 0, 5}, {1, 0, -1}), std::nullopt);
  EXPECT_EQ(ground.first_crossing({0, 0, 5}, {0, 0, 1}), std::nullopt) << "away from the ground";
  EXPECT_EQ(ground.first_crossing({0, 0, 5}, {1, 0, 0}), std::nullopt) << "above it all the way";
}

// A steeper street with all parameters that bend its ground.
Ground steeper_street() {
  StreetShape shape = hilly_street();
  shape.grade = 0.1;
  shape.grade_changes = {{.change = -0.2, .x = 15}};
  return make_ground(shape);
}

TEST(FirstCrossing, IsOnTheGroundWithNoGroundInFront) {
  const Ground ground = steeper_street();
  Random random(7);
  for (int ray = 0; ray < 5'000; ++ray) {
    const Vector3 origin{random.uniform(-25, 25), random.uniform(-20, 20), random.uniform(-4, 4)};
    const bool above = origin.z > ground.height(origin.x, origin.y);
    const Vector3 direction{random.uniform(-1, 1), random.uniform(-1, 1), above ? -1.0 : 1.0};
    const auto gap = [&](double way) {
      const Vector3 at = origin + way * direction;
      return (above ? 1 : -1) * (at.z - ground.height(at.x, at.y));
    };

    const std::optional<double> way = ground.first_crossing(origin, direction);

    ASSERT_TRUE(way) << "ray " << ray;
    ASSERT_NEAR(gap(*way), 0, 1e-9) << "ray " << ray;
    for (int part = 0; part < 50; ++part) {
      ASSERT_GT(gap(*way * part / 50), -1e-9) << "ray " << ray << ", part " << part;
    }
  }
}

TEST(TrueGround, IsMeasuredAlongTheZAxisOfATiltedSensor) {
  const Ground ground = slope_ground();
  const double slope = std::atan(0.1);
  // 2 m above a vehicle on the slope, so that the ground is level in its frame.
  const Frame pose = raised(frame_on_wheels(ground, 0, 0, 0.5, 2, 1), 2);

  const std::vector<float> heights =
      true_ground(ground, pose, std::vector<float>{3, 1, 0.5F, 0, -4, 0, 2, 2, -2, 0, 1, 1, -3, 0});

  ASSERT_EQ(heights.size(), 3U);
  for (const float height : heights) EXPECT_NEAR(height, -2, 1e-6);
  EXPECT_NEAR(std::acos(pose.up.z), slope, 1e-12);
}

TEST(TrueGround, PointBelowTheGroundGetsTheGroundAboveIt) {
  const Frame level{.origin = {0, 0, 2}};

  const std::vector<float> heights =
      true_ground(step_ground(), level, std::vector<float>{1, 3, -4, 0, 1, -3, -4, 0});

  EXPECT_EQ(heights, (std::vector<float>{-1, -2}));
}

TEST(TrueGround, IsUnknownBeyondTheGround) {
  const Frame level{.origin = {0, 0, 2}};

  const std::vector<float> heights =
      true_ground(step_ground(), level, std::vector<float>{12, 0, -2, 0});

  ASSERT_EQ(heights.size(), 1U);
  EXPECT_TRUE(std::isnan(heights[0]));
}

TEST(TrueGround, IsUnknownForAMissingReturn) {
  const Frame level{.origin = {0, 0, 2}};

  const std::vector<float> heights =
      true_ground(step_ground(), level, std::vector<float>{0, 0, 0, 0, 0, 0, 0.5F, 0});

  EXPECT_TRUE(std::isnan(heights[0]));
  EXPECT_EQ(heights[1], -2);
}

class TrueGroundOfScene : public testing::TestWithParam<std::string_view> {};

TEST_P(TrueGroundOfScene, MatchesGroundPointsWithoutNoise) {
  Sensor sensor = Sensor::named("hdl-64e");
  sensor.firings = 360;
  const Drive drive(*find_scene_kind(GetParam()), sensor, 3);
  const Scene scene = drive.scene();
  for (const int frame : {0, 6}) {
    const SimulatedScan scan = drive.scan(scene, no_noise(), frame);

    const std::vector<float> heights =
        true_ground(scene.ground(), drive.poses()[static_cast<std::size_t>(frame)], scan.xyzi);

    ASSERT_EQ(heights.size(), scan.size());
    std::size_t faces = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const float height = scan.xyzi[4 * i + 2] - heights[i];
      ASSERT_GT(height, -0.002) << "point " << i;
      if (is_ground(static_cast<SemanticClass>(scan.classes[i]))) faces += height > 0.002;
    }
    // Rounding may move a point off the edge of a steep face, and then the ground is well below it.
    EXPECT_LE(faces, scan.size() / 2'000);
  }
}

TEST(StreetGround, MatchesTheGroundPointsOfAScan) {
  const SimulatedScan scan = simulate_street(3, 2);

  const std::vector<float> heights = street_ground(3, scan.xyzi);
  const std::vector<float> of_another = street_ground(4, scan.xyzi);

  ASSERT_EQ(heights.size(), scan.size());
  std::size_t near = 0;
  std::size_t near_another = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!is_ground(static_cast<SemanticClass>(scan.classes[i]))) continue;
    constexpr float range_noise = 0.1F;  // metres; the error of a height is smaller
    const float z = scan.xyzi[4 * i + 2];
    ++all;
    near += std::abs(z - heights[i]) < range_noise;
    near_another += std::abs(z - of_another[i]) < range_noise;
  }
  EXPECT_GT(near, all - all / 100);
  EXPECT_LT(near_another, near);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TrueGroundOfScene,
                         testing::Values("flat_street", "steep_street", "parked_cars",
                                         "bushes_and_lawn", "bumpy_field", "steps", "drops"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace flagstone::sim
