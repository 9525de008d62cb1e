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
#include "lab/sim/scene.hpp"
#include "lab/sim/stands_clear.hpp"

namespace flagstone::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

const SceneKind& kind_named(std::string_view name) { return *find_scene_kind(name); }

// An HDL-64E with a sixth of the firings, to save time.
Sensor sparse_sensor() {
  Sensor sensor = Sensor::named("hdl-64e");
  sensor.firings = 360;
  return sensor;
}

Drive plan(std::string_view name, std::uint64_t seed) {
  return {kind_named(name), sparse_sensor(), seed};
}

// A run and its scene.
struct World {
  explicit World(std::string_view name, std::uint64_t seed = 1)
      : drive(plan(name, seed)), scene(drive.scene()) {}

  [[nodiscard]] double above_ground(Vector3 point) const {
    return point.z - scene.ground().height(point.x, point.y);
  }
  [[nodiscard]] SemanticClass class_at(const RayCaster::Hit& hit) const {
    return scene.caster().mesh().surface(hit.triangle).semantic;
  }

  Drive drive;
  Scene scene;
};

// A point of a scan in world coordinates.
Vector3 world_point(const Frame& pose, const SimulatedScan& scan, std::size_t i) {
  return pose.to_world({scan.xyzi[4 * i], scan.xyzi[4 * i + 1], scan.xyzi[4 * i + 2]});
}

double grade_of(const Frame& pose) {
  return pose.forward.z / std::hypot(pose.forward.x, pose.forward.y);
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, GroundTruthIsExact) {
  const World world(GetParam());
  for (const int frame : {0, 5, 9}) {
    const Frame& pose = world.drive.poses()[static_cast<std::size_t>(frame)];
    const SimulatedScan scan = world.drive.scan(world.scene, no_noise(), frame);
    std::size_t ground = 0;
    std::size_t of_another_class = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Vector3 point = world_point(pose, scan, i);
      const auto semantic = static_cast<SemanticClass>(scan.classes[i]);
      if (!is_ground(semantic)) {
        ASSERT_GT(world.above_ground(point), -0.001) << "point " << i;
        continue;
      }
      ++ground;
      ASSERT_NEAR(world.above_ground(point), 0, 0.001) << "point " << i;
      of_another_class += world.scene.ground().surface(point.x, point.y).semantic != semantic;
    }
    EXPECT_GT(ground, 2'000U);
    EXPECT_LE(of_another_class, ground / 1'000);  // rounding over the border between two surfaces
  }
}

TEST_P(EveryScene, SensorIsClearOfObjectsAndSeesGroundAheadAndBehind) {
  const World world(GetParam(), 2);
  for (int frame = 0; frame < frames_per_drive; ++frame) {
    const Frame& pose = world.drive.poses()[static_cast<std::size_t>(frame)];
    // The ground is farther away than 1.2 m, but the ceiling of a car park may be closer.
    EXPECT_TRUE(stands_clear(world.scene.caster(), pose, 1.2, 0.4)) << "frame " << frame;
    if (frame % 4 != 0) continue;
    const SimulatedScan scan = world.drive.scan(world.scene, Noise{}, frame);
    std::size_t ahead = 0;
    std::size_t behind = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const float x = scan.xyzi[4 * i];
      const float y = scan.xyzi[4 * i + 1];
      if (!is_ground(static_cast<SemanticClass>(scan.classes[i])) || std::abs(y) > 5) continue;
      ahead += x > 0 && x < 15;
      behind += x < 0 && x > -15;
    }
    EXPECT_GT(ahead, 500U) << "frame " << frame;
    EXPECT_GT(behind, 500U) << "frame " << frame;
  }
}

TEST_P(EveryScene, StopsAreOneFrameSpacingApartAtTheSensorHeight) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const Landscape landscape = kind_named(GetParam()).make(seed);
    const Drive drive = plan(GetParam(), seed);
    ASSERT_EQ(drive.poses().size(), std::size_t{frames_per_drive});
    for (std::size_t i = 0; i < drive.poses().size(); ++i) {
      const Frame& pose = drive.poses()[i];
      const Vector3 below = pose.origin - Sensor::named("hdl-64e").height * pose.up;
      EXPECT_NEAR(below.z, landscape.ground.height(below.x, below.y), 0.001);
      if (i == 0) continue;
      EXPECT_NEAR(pose.origin.x - drive.poses()[i - 1].origin.x, frame_spacing, 2);
    }
  }
}

TEST_P(EveryScene, DiffersBetweenSeeds) {
  const auto things = [](std::uint64_t seed) {
    const Landscape land = kind_named(GetParam()).make(seed);
    return land.furnish(land.ground, {}).vertices();
  };
  const std::vector<Vector3> one = things(1);

  EXPECT_EQ(one, things(1));
  EXPECT_NE(one, things(2));
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneKind& kind : scene_kinds()) names.emplace_back(kind.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST(SceneKinds, AreFoundByName) {
  for (const SceneKind& kind : scene_kinds()) EXPECT_EQ(find_scene_kind(kind.name), &kind);
  EXPECT_EQ(find_scene_kind("moon"), nullptr);
  EXPECT_EQ(find_scene_kind(""), nullptr);
}

// Scenes with traffic.
class MovingScene : public testing::TestWithParam<const char*> {};

TEST_P(MovingScene, TrafficMovesBetweenStopsClearOfTheSensor) {
  const Landscape land = kind_named(GetParam()).make(3);
  ASSERT_TRUE(land.moving);
  const Drive drive = plan(GetParam(), 3);
  std::vector<Vector3> before;
  for (int stop = 0; stop < frames_per_drive; ++stop) {
    Mesh now = land.moving(land.ground, stop);
    EXPECT_EQ(now.vertices(), land.moving(land.ground, stop).vertices());
    EXPECT_NE(now.vertices(), before) << "stop " << stop;
    before = now.vertices();
    const Frame& pose = drive.poses()[static_cast<std::size_t>(stop)];
    EXPECT_TRUE(stands_clear(RayCaster(std::move(now)), pose, 2.4, 2.4)) << "stop " << stop;
  }
}

TEST_P(MovingScene, ContinuousRunStaysClearOfTrafficAndObjects) {
  const Landscape land = kind_named(GetParam()).make(3);
  const Sensor& sensor = Sensor::named("hdl-64e");
  const Drive drive(kind_named(GetParam()), sensor, {.height = sensor.height}, 3, {.rate = 5});
  const Scene scene = drive.scene();
  for (std::size_t frame = 0; frame < drive.poses().size(); ++frame) {
    const Frame& pose = drive.poses()[frame];
    const double seconds = static_cast<double>(frame) / 5;
    EXPECT_TRUE(stands_clear(RayCaster(land.moving(land.ground, seconds)), pose, 2.2, 2.2))
        << "scan " << frame;
    EXPECT_TRUE(stands_clear(scene.caster(), pose, 1.1, 0.4)) << "scan " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MovingScene,
                         testing::Values("urban_street", "highway", "crossroads", "ramp", "tunnel",
                                         "indoor_hall"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(SteepStreet, MostSequencesHaveUphillAndDownhillGradesAboveTenPercent) {
  constexpr int drives = 20;
  int steep = 0;
  int up = 0;
  int down = 0;
  for (std::uint64_t seed = 0; seed < drives; ++seed) {
    double highest = 0;
    double lowest = 0;
    const Drive drive = plan("steep_street", seed);
    for (const Frame& pose : drive.poses()) {
      highest = std::max(highest, grade_of(pose));
      lowest = std::min(lowest, grade_of(pose));
      EXPECT_LT(std::abs(grade_of(pose)), 0.28);
    }
    up += highest > 0.1;
    down += lowest < -0.1;
    steep += highest > 0.1 || lowest < -0.1;
  }

  EXPECT_GT(steep, drives * 8 / 10);
  EXPECT_GT(up, drives / 4);
  EXPECT_GT(down, drives / 4);
}

TEST(FlatStreet, HasNoGradeAboveTwoPercentUnderTheWheels) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Drive drive = plan("flat_street", seed);
    for (const Frame& pose : drive.poses()) {
      EXPECT_LT(std::abs(grade_of(pose)), 0.02);
    }
  }
}

// Fraction of positions along the path with a car within `reach` metres, to the right and to the
// left.
std::array<double, 2> cars_beside_the_path(const World& world, double reach) {
  std::array<double, 2> share{};
  int places = 0;
  for (const Frame& pose : world.drive.poses()) {
    for (double ahead = -3.5; ahead < 4; ahead += 0.5, ++places) {
      const Vector3 at = pose.to_world({ahead, 0, 0.6 - Sensor::named("hdl-64e").height});
      for (const std::size_t side : {0U, 1U}) {
        const Vector3 aside = (side == 0 ? -1.0 : 1.0) * pose.left;
        const auto hit = world.scene.caster().cast(at, aside, 0, reach);
        share[side] += hit && world.class_at(*hit) == SemanticClass::car;
      }
    }
  }
  for (double& value : share) value /= places;
  return share;
}

TEST(ParkedCars, AreWithinThreeMetresOfThePathOnBothSides) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const auto [right, left] = cars_beside_the_path(World("parked_cars", seed), 3);
    EXPECT_GT(right, 0.4) << "seed " << seed;
    EXPECT_GT(left, 0.4) << "seed " << seed;
  }
}

TEST(BushesAndLawn, LowVegetationIsNextToThePathAndBushesAreFurtherOut) {
  const World world("bushes_and_lawn");
  std::size_t low = 0;
  std::size_t bushes = 0;
  std::size_t buildings = 0;
  std::size_t points = 0;
  for (const int frame : {1, 4, 7}) {
    const SimulatedScan scan = world.drive.scan(world.scene, Noise{}, frame);
    const Frame& pose = world.drive.poses()[static_cast<std::size_t>(frame)];
    points += scan.size();
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const auto semantic = static_cast<SemanticClass>(scan.classes[i]);
      buildings += semantic == SemanticClass::building;
      if (semantic != SemanticClass::vegetation) continue;
      const double height = world.above_ground(world_point(pose, scan, i));
      low += height < 0.4 && std::abs(scan.xyzi[4 * i + 1]) < 6;
      bushes += height > 0.4 && height < 2;
    }
  }

  EXPECT_GT(low, points / 100);
  EXPECT_GT(bushes, points / 20);
  EXPECT_LT(buildings, points / 10);
}

// Roughness along the paths of some runs: the RMS difference between the height of the ground and
// the mean of the heights 1 m before and behind, metres.
double bumpiness(std::string_view name) {
  double sum = 0;
  int places = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Landscape land = kind_named(name).make(seed);
    for (const Stop& stop : land.route) {
      const auto height = [&](double ahead) {
        return land.ground.height(stop.x + ahead * std::cos(stop.yaw),
                                  stop.y + ahead * std::sin(stop.yaw));
      };
      for (double at = -4; at < 4; at += 0.5, ++places) {
        const double bent = height(at) - (height(at - 1) + height(at + 1)) / 2;
        sum += bent * bent;
      }
    }
  }
  return std::sqrt(sum / places);
}

TEST(BumpyField, IsBumpierThanEveryStreet) {
  const double field = bumpiness("bumpy_field");

  EXPECT_GT(field, 0.01);
  EXPECT_LT(field, 0.1) << "a vehicle has to pass";
  for (const char* street : {"flat_street", "steep_street", "parked_cars"}) {
    EXPECT_GT(field, 3 * bumpiness(street)) << street;
  }
}

TEST(BumpyField, MakesTheVehiclePitchAndRoll) {
  double pitch = 0;
  double roll = 0;
  int stops = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Drive drive = plan("bumpy_field", seed);
    for (const Frame& pose : drive.poses()) {
      pitch += pose.forward.z * pose.forward.z;
      roll += pose.left.z * pose.left.z;
      ++stops;
    }
  }

  EXPECT_GT(std::sqrt(pitch / stops) * degrees, 3);
  EXPECT_GT(std::sqrt(roll / stops) * degrees, 3);
}

TEST(Ramp, RisesOrDescendsOneStoreyAtTwelveToFifteenPercent) {
  int up = 0;
  constexpr int drives = 12;
  for (std::uint64_t seed = 0; seed < drives; ++seed) {
    const Landscape land = kind_named("ramp").make(seed);
    const double rise = land.ground.height(50, 0) - land.ground.height(-50, 0);
    EXPECT_GT(std::abs(rise), 2.5);
    EXPECT_LT(std::abs(rise), 3.3);
    double steepest = 0;
    for (double x = -50; x < 50; x += 1) {
      const double climb = land.ground.height(x + 1, 0) - land.ground.height(x, 0);
      steepest = std::max(steepest, std::abs(climb));
    }
    EXPECT_GT(steepest, 0.119);
    EXPECT_LT(steepest, 0.151);
    up += rise > 0;
  }
  EXPECT_GT(up, 0);
  EXPECT_LT(up, drives);
}

// Height of the nearest object above the sensor, metres above the ground; 100 if there is none.
double ceiling_over(const World& world, const Frame& pose) {
  const auto hit = world.scene.caster().cast(pose.origin, {0, 0, 1}, 0.1, 100);
  return hit ? world.above_ground(pose.origin) + hit->range : 100;
}

TEST(Ramp, HasACeilingOverEveryStop) {
  const World world("ramp", 2);
  for (const Frame& pose : world.drive.poses()) EXPECT_LT(ceiling_over(world, pose), 6.5);
  // A storey has a low ceiling.
  EXPECT_LT(ceiling_over(world, world.drive.poses().front()), 2.85);
}

TEST(Tunnel, StartsOrEndsDuringTheSequence) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const World world("tunnel", seed);
    const bool first = ceiling_over(world, world.drive.poses().front()) < 7;
    const bool last = ceiling_over(world, world.drive.poses().back()) < 7;
    EXPECT_NE(first, last) << "seed " << seed;
  }
}

TEST(Tunnel, HasAReflectiveWetRoad) {
  const Landscape land = kind_named("tunnel").make(1);
  int wet = 0;
  for (const Stop& stop : land.route) {
    for (double aside = -2; aside < 5; aside += 0.25) {
      for (double ahead = 0; ahead < 8; ahead += 0.5) {
        wet += land.ground.surface(stop.x + ahead, stop.y + aside).mirror > 0.5F;
      }
    }
  }
  EXPECT_GT(wet, 50);
}

TEST(Steps, ListedStepsMatchTheGroundAlongTheirLength) {
  for (const char* const scene : {"steps", "drops"}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Landscape land = kind_named(scene).make(seed);
      for (const GroundStep& step : land.steps) {
        for (const double share : {0.001, 0.5, 0.999}) {
          const double x = step.x_begin + share * (step.x_end - step.x_begin);
          const double rise =
              land.ground.height(x, step.y_end) - land.ground.height(x, step.y_begin);
          EXPECT_NEAR(rise, step.rise, 1e-9) << step.kind << " at " << x;
        }
      }
    }
  }
}

TEST(Drops, AreAtLeastOneMetreDeepNextToTheRouteForEverySeed) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Landscape land = kind_named("drops").make(seed);
    const auto depths_beside_route = [&](double depth) {
      return std::ranges::any_of(land.steps, [&](const GroundStep& step) {
        return std::abs(step.rise + depth) < 1e-9 && step.x_begin < half_drive + 30 &&
               step.x_end > -half_drive - 30;
      });
    };
    for (const double depth : {1.0, 1.5, 2.0, 3.0}) EXPECT_TRUE(depths_beside_route(depth));
    EXPECT_FALSE(depths_beside_route(0.6));
  }
}

TEST(Steps, HasEveryKindNextToTheRouteForEverySeed) {
  const std::vector<std::pair<std::string_view, double>> kinds{
      {"kerb, 5 cm up", 0.05},        {"kerb, 10 cm up", 0.1},
      {"kerb, 15 cm up", 0.15},       {"ditch, 60 cm down", -0.6},
      {"ditch, 60 cm up again", 0.6}, {"retaining wall, 1 m down", -1},
      {"stairs, 5 x 16 cm up", 0.8},  {"embankment, 1.5 m up", 1.5}};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Landscape land = kind_named("steps").make(seed);
    for (const auto& [kind, rise] : kinds) {
      EXPECT_TRUE(std::ranges::any_of(land.steps,
                                      [&](const GroundStep& step) {
                                        return step.kind == kind &&
                                               std::abs(step.rise - rise) < 1e-9 &&
                                               step.x_begin < half_drive + 30 &&
                                               step.x_end > -half_drive - 30;
                                      }))
          << kind << ", seed " << seed;
    }
  }
}

TEST(SimulatedRun, ScansAreTheSameWhenTheSceneIsBuiltAgain) {
  const World one("bumpy_field", 3);
  const World again("bumpy_field", 3);
  for (const int frame : {0, 9}) {
    const SimulatedScan scan = one.drive.scan(one.scene, Noise{}, frame);
    const SimulatedScan second = again.drive.scan(again.scene, Noise{}, frame);
    EXPECT_EQ(scan.xyzi, second.xyzi);
    EXPECT_EQ(scan.classes, second.classes);
  }
}

TEST(SimulatedRun, ScenesOfASequenceDiffer) {
  EXPECT_NE(drive_seed(1, 0), drive_seed(1, 1));
  EXPECT_NE(drive_seed(1, 0), drive_seed(2, 0));
  for (const SceneKind& kind : scene_kinds()) {
    const Drive one(kind, sparse_sensor(), drive_seed(1, 0));
    const Drive other(kind, sparse_sensor(), drive_seed(1, 1));
    EXPECT_NE(one.poses()[3].origin, other.poses()[3].origin) << kind.name;
  }
}

}  // namespace
}  // namespace flagstone::sim
