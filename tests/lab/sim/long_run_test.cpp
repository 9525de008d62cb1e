// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Environments of several stretches, and circuits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/extent.hpp"
#include "lab/sim/flat_scene.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/stands_clear.hpp"

namespace flagstone::sim {
namespace {

constexpr Extent street{.stretches = 4};
constexpr Extent circuit{.stretches = 10, .closed = true};

std::vector<std::string> long_scenes() {
  std::vector<std::string> names;
  for (const SceneKind& kind : scene_kinds()) {
    if (kind.make_long != nullptr) names.emplace_back(kind.name);
  }
  return names;
}

const SceneKind& kind_named(const std::string& name) { return *find_scene_kind(name); }

Drive run_through(const std::string& name, const Extent& extent, const Pace& pace = {}) {
  const Sensor& sensor = Sensor::named("vlp-16");
  return {kind_named(name), sensor, {.height = sensor.height}, 1, pace, extent};
}

TEST(LongRun, ScenesOfEveryLengthAreTheSixThatMapsNeed) {
  EXPECT_THAT(long_scenes(),
              testing::UnorderedElementsAre("parked_cars", "park", "forest_track", "urban_street",
                                            "highway", "crossroads"));
}

TEST(LongRun, ShortestLengthIsTheSceneWithoutALength) {
  for (const std::string& name : long_scenes()) {
    const SceneKind& kind = kind_named(name);
    const Landscape one = kind.make(3);
    const Landscape same = kind.make_long(3, {});

    EXPECT_EQ(one.furnish(one.ground, {}).vertices(), same.furnish(same.ground, {}).vertices());
  }
}

class LongScene : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  [[nodiscard]] static std::string name() { return std::get<0>(GetParam()); }
  [[nodiscard]] static const Extent& extent() { return std::get<1>(GetParam()) ? circuit : street; }
};

// Compares heights on both sides of a joint, in road coordinates. A circuit repeats, so that the
// joint of its ends is one of them.
TEST_P(LongScene, GroundIsContinuousOverJoints) {
  const Landscape land = kind_named(name()).make_long(2, extent());
  constexpr double beside = 0.002;  // metres
  double highest_step = 0;
  for (std::size_t joint = 1; joint <= extent().stretches; ++joint) {
    const double x = extent().begin() + static_cast<double>(joint) * stretch_length;
    for (double y = -25; y < 25; y += 0.05) {
      const double before = land.ground.height(x - beside, y);
      const double behind = land.ground.height(x + beside, y);
      highest_step = std::max(highest_step, std::abs(behind - before));
    }
  }
  EXPECT_LT(highest_step, 0.015) << "a kerb is at least 0.07 m high";
}

TEST_P(LongScene, PosesAreSmoothOverJoints) {
  const Drive drive = run_through(name(), extent(), {.rate = 40});  // 0.2 m apart
  const std::vector<Frame>& poses = drive.poses();
  ASSERT_EQ(poses.size(), extent().stretches_of_run() * 360 + 1);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Vector3 motion = poses[i].origin - poses[i - 1].origin;
    ASSERT_NEAR(length(motion), 0.2, 0.08) << "scan " << i;
    ASSERT_LT(length(poses[i].up - poses[i - 1].up), 0.06) << "scan " << i;
    ASSERT_GT(dot(motion, poses[i].forward), 0.9 * length(motion)) << "scan " << i;
  }
}

TEST_P(LongScene, GroundTruthIsExactAtTheLastJoint) {
  const Drive drive = run_through(name(), extent());
  // On a circuit, the end of the first lap is at the joint that closes it.
  const std::size_t frame = extent().stretches * stops_per_stretch;
  const Scene scene = drive.scene(frame);
  const SimulatedScan scan = drive.scan(scene, no_noise(), static_cast<int>(frame));
  const std::vector<float> ground = drive.ground_of(scan, static_cast<int>(frame));
  std::size_t on_ground = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double above = point_of(scan, i).z - static_cast<double>(ground[i]);
    if (is_ground(class_of(scan, i))) {
      ASSERT_NEAR(above, 0, 0.001) << "point " << i;
      ++on_ground;
    } else {
      ASSERT_FALSE(above < -0.001) << "point " << i;
    }
  }
  EXPECT_GT(on_ground, 1'000U);
}

TEST_P(LongScene, RunStaysClearOfObjectsAndTraffic) {
  const Landscape land = kind_named(name()).make_long(1, extent());
  const std::size_t last = extent().stretches - 1;
  for (const std::size_t stretch : {last - 1, last}) {
    const RayCaster objects(land.furnish(land.ground, extent().stretch(stretch)));
    const std::size_t begin = stretch * stops_per_stretch;
    for (std::size_t stop = begin; stop <= begin + stops_per_stretch; ++stop) {
      const Stop& at = land.route[stop];
      const Mounting mounting{.height = Sensor::named("hdl-64e").height};
      const Frame pose = sensor_pose(vehicle_pose(land.ground, at.x, at.y, at.yaw), mounting);
      const RayCaster moving(land.moving ? land.moving(land.ground, static_cast<double>(stop))
                                         : Mesh());
      EXPECT_TRUE(stands_clear(moving, pose, 2.2, 2.2)) << "stop " << stop;
      EXPECT_TRUE(stands_clear(objects, pose, 1.1, 0.4)) << "stop " << stop;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LongScene,
                         testing::Combine(testing::ValuesIn(long_scenes()), testing::Bool()),
                         [](const auto& scene) {
                           return std::get<0>(scene.param) +
                                  (std::get<1>(scene.param) ? "_circuit" : "_street");
                         });

TEST(LongRun, TrafficMovesAroundTheSensorInEveryStretch) {
  for (const char* name : {"urban_street", "highway", "crossroads"}) {
    for (const Extent& extent : {street, circuit}) {
      const Landscape land = kind_named(name).make_long(1, extent);
      for (std::size_t i = 0; i < extent.stretches_of_run(); ++i) {
        const double seconds = static_cast<double>(i) * stops_per_stretch + 4;
        const Mesh mesh = land.moving(land.ground, seconds);
        const double own = land.route[static_cast<std::size_t>(seconds)].x;
        std::size_t moving = 0;
        for (std::size_t triangle = 0; triangle < mesh.triangles().size(); ++triangle) {
          moving += mesh.surface(triangle).motion == Motion::now &&
                    std::abs(mesh.corner(triangle, 0).x - own) < 60;
        }
        EXPECT_GT(moving, 100U) << name << ", stretch " << i;
      }
    }
  }
}

TEST(LongRun, SecondLapPassesTheSameEnvironment) {
  const Drive drive = run_through("park", circuit);
  const std::size_t lap = circuit.stretches;
  const auto first = Drive::parts_of(3, {}, circuit);
  const auto second = Drive::parts_of(3 + lap * stops_per_stretch, {}, circuit);

  EXPECT_EQ(second.first, first.first + lap);
  for (const std::size_t part : {first.first, first.first + 5}) {
    EXPECT_EQ(drive.part(part)->mesh().vertices(), drive.part(part + lap)->mesh().vertices());
  }
  const Vector3 start = drive.poses()[0].origin;
  const Vector3 again = drive.poses()[lap * stops_per_stretch].origin;
  EXPECT_LT(length(again - start), 2) << "each lap deviates from the path on its own";
  EXPECT_GT(length(again - start), 0);
}

TEST(LongRun, StretchesOfOneEnvironmentDiffer) {
  for (const std::string& name : long_scenes()) {
    const Landscape land = kind_named(name).make_long(1, circuit);
    const Mesh one = land.furnish(land.ground, circuit.stretch(3));
    const Mesh other = land.furnish(land.ground, circuit.stretch(6));

    EXPECT_NE(one.vertices().size(), other.vertices().size()) << name;
  }
}

TEST(LongRun, ScanNeedsTheStretchesWithinTwoHundredMetres) {
  for (const std::size_t frame : {0U, 9U, 40U, 89U}) {
    const auto [first, count] = Drive::parts_of(frame, {}, circuit);
    EXPECT_EQ(count, 7U);
    EXPECT_EQ(first, frame / 9);
    EXPECT_LE(first + count, Drive::part_count(circuit));
  }
  const auto [first, count] = Drive::parts_of(0, {}, Extent{.stretches = 20});
  EXPECT_EQ(first, 0U);
  EXPECT_EQ(count, 4U);
}

}  // namespace
}  // namespace flagstone::sim
