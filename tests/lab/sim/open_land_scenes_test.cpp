// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/plants.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Landscape land_of(std::string_view scene, std::uint64_t seed) {
  return find_scene_kind(scene)->make(seed);
}

double distance_to_route(const std::vector<Stop>& route, double x, double y) {
  double nearest = 1e9;
  for (std::size_t i = 0; i + 1 < route.size(); ++i) {
    const double way_x = route[i + 1].x - route[i].x;
    const double way_y = route[i + 1].y - route[i].y;
    const double from_x = x - route[i].x;
    const double from_y = y - route[i].y;
    const double share =
        std::clamp((from_x * way_x + from_y * way_y) / (way_x * way_x + way_y * way_y), 0.0, 1.0);
    nearest = std::min(nearest, std::hypot(from_x - share * way_x, from_y - share * way_y));
  }
  return nearest;
}

class OpenLand : public testing::TestWithParam<std::string> {};

TEST_P(OpenLand, MovingObjectsMoveBetweenStopsAndStayClearOfThePath) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Landscape land = land_of(GetParam(), seed);
    for (const int stop : {0, 4, 9}) {
      const Mesh now = land.moving(land.ground, stop);
      const Mesh next = land.moving(land.ground, stop + 1);
      ASSERT_FALSE(now.vertices().empty());
      EXPECT_GT(length(next.vertices().front() - now.vertices().front()), 0.3) << "seed " << seed;
      double nearest = 1e9;
      for (const Vector3& vertex : now.vertices()) {
        nearest = std::min(nearest, distance_to_route(land.route, vertex.x, vertex.y));
      }
      EXPECT_GE(nearest, 3) << "seed " << seed << ", stop " << stop;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, OpenLand,
                         testing::Values("park", "forest_track", "ploughed_field", "embankment",
                                         "construction_site"),
                         [](const auto& scene) { return scene.param; });

TEST(RoughScenes, MakeTheVehiclePitchAndRoll) {
  for (const std::string_view scene : {"forest_track", "ploughed_field"}) {
    double pitch = 0;
    double roll = 0;
    int stops = 0;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Drive drive(*find_scene_kind(scene), Sensor::named("hdl-64e"), seed);
      for (const Frame& pose : drive.poses()) {
        pitch += pose.forward.z * pose.forward.z;
        roll += pose.left.z * pose.left.z;
        ++stops;
      }
    }
    EXPECT_GT(std::sqrt(pitch / stops) * degrees, 1.5) << scene;
    EXPECT_GT(std::sqrt(roll / stops) * degrees, 1.5) << scene;
  }
}

TEST(PloughedField, FurrowsAreFifteenToTwentyFiveCentimetresDeepWhereTheVehicleCrossesThem) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Landscape land = land_of("ploughed_field", seed);
    std::vector<double> depths;
    for (const Stop& stop : land.route) {
      double low = 1e9;
      double high = -1e9;
      for (double y = -0.4; y < 0.4; y += 0.02) {  // across the widest furrow
        const double height = land.ground.height(stop.x, stop.y + y);
        low = std::min(low, height);
        high = std::max(high, height);
      }
      depths.push_back(high - low);
    }
    std::ranges::nth_element(depths, depths.begin() + 5);
    // The limits allow for clods and the slope of the land.
    EXPECT_GT(depths[5], 0.13) << "seed " << seed;
    EXPECT_LT(depths[5], 0.36) << "seed " << seed;
  }
}

TEST(Embankment, ListedStepsMatchTheGroundAlongTheirLength) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Landscape land = land_of("embankment", seed);
    for (const GroundStep& step : land.steps) {
      for (const double share : {0.001, 0.5, 0.999}) {
        const double x = step.x_begin + share * (step.x_end - step.x_begin);
        const double rise = land.ground.height(x, step.y_end) - land.ground.height(x, step.y_begin);
        EXPECT_NEAR(rise, step.rise, 1e-9) << step.kind << " at " << x << ", seed " << seed;
      }
    }
  }
}

TEST(Embankment, HasDropDamDitchAndCuttingNextToEveryRoute) {
  struct Expected {
    std::string_view kind;
    double lowest, highest;
  };
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::vector<GroundStep> steps = land_of("embankment", seed).steps;
    for (const auto& [kind, lowest, highest] :
         {Expected{"dam down", -4, -2}, Expected{"retaining wall down", -3, -1},
          Expected{"ditch up again", 0.5, 1.5}, Expected{"cutting up", 1.8, 3.2}}) {
      EXPECT_TRUE(std::ranges::any_of(steps,
                                      [&](const GroundStep& step) {
                                        return step.kind == kind && step.rise >= lowest &&
                                               step.rise <= highest && step.x_begin < half_drive &&
                                               step.x_end > -half_drive;
                                      }))
          << kind << ", seed " << seed;
    }
  }
}

TEST(ConstructionSite, HasAPitOneToThreeMetresDeepNextToEveryRoute) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Landscape land = land_of("construction_site", seed);
    double deepest = 0;
    for (const Stop& stop : land.route) {
      const double here = land.ground.height(stop.x, stop.y);
      for (double t = -25; t < 25; t += 0.5) {
        deepest = std::max(deepest, here - land.ground.height(stop.x, stop.y + t));
      }
    }
    EXPECT_GT(deepest, 0.9) << "seed " << seed;
    EXPECT_LT(deepest, 4) << "seed " << seed;
  }
}

TEST(Park, HasAReflectivePondNextToEveryRoute) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Landscape land = land_of("park", seed);
    int water = 0;
    for (double x = -40; x < 40; x += 1) {
      for (double y = -35; y < 35; y += 1) water += land.ground.surface(x, y).mirror > 0.5F;
    }
    EXPECT_GT(water, 50) << "seed " << seed;
  }
}

// Level ground of 40 by 40 m.
Ground lawn() {
  return {{.x = {-20, 20}, .offset = {0, 0}, .t = {-20, 20}},
          {0, 0, 0, 0},
          {{.semantic = SemanticClass::terrain}}};
}

TEST(HighGrass, HidesPartOfTheGround) {
  const Ground ground = lawn();
  for (const double height : {0.3, 0.8}) {
    Mesh mesh;
    Random random(1);
    add_high_grass(mesh, ground, {.radius = 4, .height = height}, random);
    ground.add_to(mesh);
    const RayCaster caster(std::move(mesh));
    int reach = 0;
    constexpr int beams = 1000;
    for (int i = 0; i < beams; ++i) {
      // Beams at 15 degrees below the horizon, to positions within 2 m of the middle.
      const double slope = std::tan(15 / degrees);
      const Vector3 target{random.uniform(-2, 2), random.uniform(-2, 2), 0};
      const Vector3 from = target + Vector3{-10, 0, 10 * slope};
      const auto hit = caster.cast(from, normalized(target - from), 0, 20);
      reach += hit && is_ground(caster.mesh().surface(hit->triangle).semantic);
    }
    EXPECT_GT(reach, beams / 50) << height;
    EXPECT_LT(reach, beams * 7 / 10) << height;
  }
}

TEST(ForestTrack, TrunksBlockManyLevelBeams) {
  const Drive drive(*find_scene_kind("forest_track"), Sensor::named("hdl-64e"), 1);
  const Scene scene = drive.scene();
  int trunks = 0;
  int beams = 0;
  for (const Frame& pose : drive.poses()) {
    for (double angle = 0; angle < 2 * std::numbers::pi; angle += 0.05, ++beams) {
      const Vector3 level{std::cos(angle), std::sin(angle), 0};
      const auto hit = scene.caster().cast(pose.origin, level, 0, 40);
      trunks +=
          hit && scene.caster().mesh().surface(hit->triangle).semantic == SemanticClass::trunk;
    }
  }

  EXPECT_GT(trunks, beams / 10);
}

}  // namespace
}  // namespace flagstone::sim
