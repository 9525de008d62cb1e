// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <numbers>
#include <utility>
#include <vector>

#include "lab/sim/ground.hpp"

namespace flagstone::sim {
namespace {

// A route along the x axis with stops own_speed metres apart.
std::vector<Stop> straight_route() {
  std::vector<Stop> route;
  for (int stop = 0; stop < frames_per_drive; ++stop) {
    route.push_back({.x = -half_drive + stop * frame_spacing, .y = 0, .yaw = 0});
  }
  return route;
}

Stop x_axis(double x) { return {.x = x, .y = 0, .yaw = 0}; }

Ground level_ground() {
  return cut_ground({.x = {-100, 100},
                     .t = {-50, 50},
                     .offset = [](double) { return 0.0; },
                     .height = [](double, double) { return 0.0; },
                     .surface = [](double, double) { return Surface{}; }});
}

double mean_x(const Mesh& mesh) {
  double sum = 0;
  for (const Vector3& vertex : mesh.vertices()) sum += vertex.x;
  return sum / static_cast<double>(mesh.vertices().size());
}

TEST(Traffic, OmitsVehiclesThatWouldPassThroughTheSensor) {
  Traffic traffic(straight_route());
  // Across the road, at the position of the sensor half a second after its fifth stop.
  const double x = -half_drive + 4.5 * frame_spacing;
  const Stop begin{.x = x, .y = -45, .yaw = std::numbers::pi / 2};

  EXPECT_FALSE(traffic.join({.kind = RoadUser::cyclist, .at = straight(begin, 10, 90)}));
  EXPECT_TRUE(traffic.join({.kind = RoadUser::cyclist, .at = straight(begin, 6, 90)}));
}

TEST(Traffic, TrucksMayPassCloserThanCars) {
  for (const auto& [kind, half_width] :
       {std::pair{RoadUser::car, 0.985}, std::pair{RoadUser::truck, 1.25}}) {
    Traffic traffic(straight_route());
    const auto passes = [&, kind = kind, half_width = half_width](double clearance) {
      return traffic.join({.kind = kind, .at = along(x_axis, half_width + clearance, 60, -8)});
    };
    EXPECT_FALSE(passes(2.4));
    EXPECT_EQ(passes(2.7), kind == RoadUser::truck);
    Traffic others(straight_route());
    EXPECT_TRUE(others.join({.kind = kind, .at = along(x_axis, half_width + 3.1, 60, -8)}));
  }
}

TEST(Traffic, OmitsVehiclesThatWouldCollide) {
  Traffic traffic(straight_route());
  ASSERT_TRUE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 6, 0, 5)}));

  EXPECT_FALSE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 6, -20, 9)}));
  EXPECT_FALSE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 6, 50, -5)}));
  EXPECT_TRUE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 6, -20, 5)}));
  EXPECT_TRUE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 9, 50, -5)}));
}

TEST(Traffic, MovesAtItsSpeedBetweenStops) {
  const Ground ground = level_ground();
  Traffic traffic(straight_route());
  ASSERT_TRUE(traffic.join({.kind = RoadUser::bus, .at = along(x_axis, 8, 10, -4)}));

  EXPECT_NEAR(mean_x(traffic.at(ground, 5)) - mean_x(traffic.at(ground, 2)), -12 * stop_interval,
              1e-9);
}

std::vector<Motion> motions(const Mesh& mesh) {
  std::vector<Motion> all;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) all.push_back(mesh.surface(i).motion);
  return all;
}

TEST(Traffic, IsMarkedByItsMotionNowAndLater) {
  const Ground ground = level_ground();
  const Stop begin{.x = 10, .y = 10, .yaw = 0};
  const auto motion_at = [&](std::function<Stop(double)> at, double seconds) {
    Traffic traffic(straight_route());
    EXPECT_TRUE(traffic.join({.kind = RoadUser::car, .at = std::move(at)}));
    const std::vector<Motion> all = motions(traffic.at(ground, seconds));
    EXPECT_FALSE(all.empty());
    EXPECT_EQ(std::ranges::count(all, all.front()), std::ssize(all));
    return all.front();
  };

  EXPECT_EQ(motion_at(straight(begin, 0, 0), 4), Motion::none);
  EXPECT_EQ(motion_at(straight(begin, 2, 90), 4), Motion::now);
  // It stops after 3 seconds.
  EXPECT_EQ(motion_at(straight(begin, 2, 6), 2), Motion::now);
  EXPECT_EQ(motion_at(straight(begin, 2, 6), 4), Motion::later);
  EXPECT_EQ(motion_at(straight(begin, 0.05, 6), 2), Motion::none);
}

TEST(Traffic, HasTheMovingClassesOnlyWhileItMoves) {
  const Surface car{.semantic = SemanticClass::car};
  Surface moving = car;
  moving.motion = Motion::now;
  Surface waiting = car;
  waiting.motion = Motion::later;

  EXPECT_EQ(labelled_class(car), SemanticClass::car);
  EXPECT_EQ(labelled_class(waiting), SemanticClass::car);
  EXPECT_EQ(labelled_class(moving), SemanticClass::moving_car);
}

TEST(Traffic, LaneIsFilledFromEndToEndAtEveryStop) {
  const Ground ground = level_ground();
  for (const double speed : {-25.0, 15.0}) {
    Traffic traffic(straight_route());
    Random random(1);
    traffic.fill(
        {.path = x_axis, .t = 10, .speed = speed, .x = {-80, 80}, .gap = {5, 10}},
        [](Random&) { return RoadUser::car; }, random);
    for (const int stop : {0, 9}) {
      double lowest = 100;
      double highest = -100;
      const Mesh mesh = traffic.at(ground, stop);
      for (const Vector3& vertex : mesh.vertices()) {
        lowest = std::min(lowest, vertex.x);
        highest = std::max(highest, vertex.x);
      }
      EXPECT_LT(lowest, -70) << "speed " << speed << ", stop " << stop;
      EXPECT_GT(highest, 70) << "speed " << speed << ", stop " << stop;
    }
  }
}

TEST(Traffic, OmitsVehiclesThatLeftTheGround) {
  Traffic traffic(straight_route());
  ASSERT_TRUE(traffic.join({.kind = RoadUser::car, .at = along(x_axis, 10, 60, 10)}));

  EXPECT_FALSE(traffic.at(level_ground(), 0).triangles().empty());
  EXPECT_TRUE(traffic.at(level_ground(), 9).triangles().empty());
}

}  // namespace
}  // namespace flagstone::sim
