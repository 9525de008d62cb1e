// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lab/sim/drive.hpp"
#include "lab/sim/flat_scene.hpp"
#include "lab/sim/measurement.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/scan.hpp"

namespace flagstone::sim {
namespace {

constexpr Surface wall{.semantic = SemanticClass::building, .reflectivity = 0.5F};
constexpr Surface glass{.semantic = SemanticClass::building, .reflectivity = 0.1F, .mirror = 1};

// A scan of `objects` along the x axis, from 1.5 m above a level road.
SimulatedScan look_ahead(Mesh objects, const Noise& noise, std::uint64_t seed = 1) {
  return simulate(flat_scene(std::move(objects)), sensor_ahead(20, 1000), noise, above_origin(1.5),
                  seed);
}

constexpr double beams_ahead = 20 * 1000;

Noise with(Noise noise, std::string_view weather) {
  find_weather(weather)->add_to(noise);
  return noise;
}

TEST(Returns, GroundPointsAreOnALevelRoadWithinTheNoiseForEverySensor) {
  const Scene scene = flat_scene();
  for (const Sensor& sensor : Sensor::known()) {
    const SimulatedScan scan = simulate(scene, sensor, Noise{}, above_origin(sensor.height), 3);
    EXPECT_GT(scan.size(), 2'000U) << sensor.name;
    double squares = 0;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Vector3 point = point_of(scan, i);
      const double sine = point.z / length(point);
      // The error along the beam that corresponds to the error in z.
      const double error = (point.z + sensor.height) / std::abs(sine);
      ASSERT_EQ(class_of(scan, i), SemanticClass::road);
      ASSERT_LT(std::abs(error), 6 * sensor.range_sigma + 0.005) << sensor.name;
      squares += error * error;
    }
    EXPECT_NEAR(std::sqrt(squares / static_cast<double>(scan.size())), sensor.range_sigma,
                0.05 * sensor.range_sigma)
        << sensor.name;
  }
}

struct Condition {
  std::string noise, weather;
};

// A street of cars with a wall of glass next to the vehicle.
struct GlassStreet {
  Landscape landscape = find_scene_kind("parked_cars")->make(2);
  Stop stop = landscape.route.front();
  Scene scene{landscape.ground, objects()};
  Frame pose = sensor_pose(landscape.ground, Sensor::named("hdl-32e"), stop.x, stop.y, stop.yaw);

 private:
  [[nodiscard]] Mesh objects() const {
    Mesh mesh = landscape.furnish(landscape.ground, {});
    const Vector3 middle{stop.x, stop.y + 4, landscape.ground.height(stop.x, stop.y)};
    const Vector3 along{9, 0, 0};
    const Vector3 top{0, 0, 3};
    mesh.add_quad(middle - along, middle + along, middle + along + top, middle - along + top,
                  glass);
    return mesh;
  }
};

class EveryCondition : public testing::TestWithParam<Condition> {
 protected:
  static Noise noise() {
    return with(find_noise_level(GetParam().noise)->noise, GetParam().weather);
  }
  static SimulatedScan scan(unsigned threads = 1) {
    Sensor sensor = Sensor::named("hdl-32e");
    sensor.firings = 720;
    return simulate(street().scene, sensor, noise(), street().pose, 5, {.threads = threads});
  }
  static const GlassStreet& street() {
    static const GlassStreet made;
    return made;
  }
};

TEST_P(EveryCondition, NonSurfaceReturnsAreOutliersAwayFromTheGround) {
  const SimulatedScan scan = EveryCondition::scan();

  ASSERT_EQ(scan.echoes.size(), scan.size());
  double all = 0;
  for (std::size_t kind = 0; kind < echo_kind_names.size(); ++kind) {
    all += count(scan, static_cast<EchoKind>(kind));
  }
  EXPECT_EQ(all, static_cast<double>(scan.size()));
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool is_outlier = class_of(scan, i) == SemanticClass::outlier;
    ASSERT_EQ(is_outlier, scan.echoes[i] != EchoKind::surface) << "point " << i;
    if (!is_outlier) continue;
    const Vector3 world = street().pose.to_world(point_of(scan, i));
    ASSERT_GT(std::abs(world.z - street().scene.ground().height(world.x, world.y)), 0.05)
        << "point " << i;
  }
}

TEST_P(EveryCondition, HasItsKindsOfReturnsAndNoOthers) {
  const SimulatedScan scan = EveryCondition::scan();
  const Noise set = noise();

  EXPECT_EQ(count(scan, EchoKind::ghost) > 0, set.mirroring > 0 || set.wetness > 0);
  EXPECT_EQ(count(scan, EchoKind::mixed) > 0, set.mixed_rate > 0);
  EXPECT_EQ(count(scan, EchoKind::rain) > 0, set.rain_rate > 0);
  EXPECT_EQ(count(scan, EchoKind::dust) > 0, set.dust_clouds > 0);
  EXPECT_EQ(count(scan, EchoKind::crosstalk) > 0, set.crosstalk_rate > 0);
  EXPECT_EQ(count(scan, EchoKind::none), 0);
}

TEST_P(EveryCondition, IsBitIdenticalForAnyNumberOfThreads) {
  const SimulatedScan one = EveryCondition::scan(1);
  const SimulatedScan three = EveryCondition::scan(3);

  EXPECT_EQ(one.xyzi, three.xyzi);
  EXPECT_EQ(one.classes, three.classes);
  EXPECT_EQ(one.echoes, three.echoes);
}

INSTANTIATE_TEST_SUITE_P(Conditions, EveryCondition,
                         testing::Values(Condition{"clean", "clear"}, Condition{"clean", "wet"},
                                         Condition{"default", "clear"},
                                         Condition{"default", "rain"}, Condition{"default", "dust"},
                                         Condition{"harsh", "clear"}, Condition{"harsh", "rain"},
                                         Condition{"harsh", "wet"}),
                         [](const auto& condition) {
                           return condition.param.noise + "_" + condition.param.weather;
                         });

TEST(Returns, GlassReflectsATenthOfTheBeamsAtRightAngles) {
  Mesh objects;
  add_wall(objects, 10, glass);
  add_wall(objects, -8, wall);
  Noise noise = no_noise();
  noise.mirroring = 1;

  const SimulatedScan scan = look_ahead(objects, noise);

  EXPECT_NEAR(count(scan, EchoKind::ghost) / beams_ahead, 0.1, 0.01);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double mirrored_wall = 10 + (10 + 8);
    ASSERT_NEAR(point_of(scan, i).x, scan.echoes[i] == EchoKind::ghost ? mirrored_wall : 10, 1e-4);
  }
}

TEST(Returns, GlassReflectsMoreAtGrazingIncidence) {
  const auto share_mirrored = [](double along) {
    Mesh objects;  // a pane, 2 m ahead at y = 0
    objects.add_quad({2 - 30 * along, -30, -1}, {2 + 30 * along, 30, -1}, {2 + 30 * along, 30, 20},
                     {2 - 30 * along, -30, 20}, glass);
    Noise noise = no_noise();
    noise.mirroring = 1;
    // Reflected beams are lost, because they hit nothing.
    return 1 - static_cast<double>(look_ahead(objects, noise).size()) / beams_ahead;
  };

  EXPECT_GT(share_mirrored(6), 2 * share_mirrored(0));
}

TEST(Returns, WetRoadShowsReflectedObjectsBelowIt) {
  Mesh objects;
  add_wall(objects, 20, wall);
  const Scene scene = flat_scene(objects);
  Sensor sensor = sensor_ahead(10, 400);
  for (double& elevation : sensor.elevations) elevation -= 10;

  const SimulatedScan dry = simulate(scene, sensor, no_noise(), above_origin(1.5), 1);
  const SimulatedScan wet = simulate(scene, sensor, with(no_noise(), "wet"), above_origin(1.5), 1);

  EXPECT_EQ(count(dry, EchoKind::ghost), 0);
  EXPECT_GT(count(wet, EchoKind::ghost), 0.02 * static_cast<double>(dry.size()));
  for (std::size_t i = 0; i < wet.size(); ++i) {
    if (wet.echoes[i] != EchoKind::ghost) continue;
    ASSERT_LT(point_of(wet, i).z, -1.5 - 0.15);
    ASSERT_NEAR(point_of(wet, i).x, 20, 1e-3);
  }
}

TEST(Returns, MixedPixelsAreBetweenTheSurfacesOfAnEdgeAtTheirRate) {
  Mesh objects;
  add_wall(objects, 11, wall);
  for (double y = -1; y < 1; y += 0.1) {  // a fence of pales 5 cm wide and 5 cm apart
    objects.add_quad({10, y, 0}, {10, y + 0.05, 0}, {10, y + 0.05, 8}, {10, y, 8}, wall);
  }
  Noise always = no_noise();
  always.mixed_rate = 1;
  Noise half = always;
  half.mixed_rate = 0.5;

  const SimulatedScan all = look_ahead(objects, always);
  const SimulatedScan some = look_ahead(objects, half);

  EXPECT_GT(count(all, EchoKind::mixed), 1'000);
  EXPECT_NEAR(count(some, EchoKind::mixed) / count(all, EchoKind::mixed), 0.5, 0.05);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.echoes[i] != EchoKind::mixed) continue;
    ASSERT_GT(point_of(all, i).x, 10.1);
    ASSERT_LT(point_of(all, i).x, 10.9);
  }
}

TEST(Returns, SingleSurfaceHasNoMixedPixelsAtAnyIncidence) {
  Noise noise = no_noise();
  noise.mixed_rate = 1;
  const Sensor& sensor = Sensor::named("hdl-64e");

  const SimulatedScan scan = simulate(flat_scene(), sensor, noise, above_origin(0.5), 1);

  EXPECT_GT(scan.size(), 50'000U);
  EXPECT_EQ(count(scan, EchoKind::mixed), 0);
}

TEST(Returns, RainReturnsItsFractionOfOpenBeamsAndNoneBehindWalls) {
  Noise noise = no_noise();
  noise.rain_rate = 0.1;
  Mesh objects;
  add_wall(objects, 3, wall);

  const SimulatedScan open = look_ahead({}, noise);
  const SimulatedScan enclosed = look_ahead(objects, noise);

  EXPECT_NEAR(count(open, EchoKind::rain) / beams_ahead, 0.1, 0.01);
  EXPECT_LT(count(enclosed, EchoKind::rain), count(open, EchoKind::rain));
  EXPECT_EQ(static_cast<double>(enclosed.size()), beams_ahead);
  for (std::size_t i = 0; i < enclosed.size(); ++i) ASSERT_LT(point_of(enclosed, i).x, 3 + 1e-4);
}

TEST(Returns, RainAttenuatesDistantReturns) {
  Mesh objects;
  add_wall(objects, 60, {.semantic = SemanticClass::building, .reflectivity = 0.02F});
  Noise rain{};
  rain.rain_extinction = 0.01;

  EXPECT_LT(look_ahead(objects, rain).size(), look_ahead(objects, Noise{}).size() * 9 / 10);
}

TEST(Returns, CrosstalkFormsStreaksAtItsRate) {
  Noise noise = no_noise();
  noise.crosstalk_rate = 0.1;
  double hits = 0;
  double bursts = 0;
  double steps = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const SimulatedScan scan = simulate(flat_scene(), sensor_ahead(20, 1000), noise,
                                        above_origin(1.5), seed, {.keep_no_returns = true});
    for (std::size_t i = 0; i < scan.size(); ++i) {
      if (scan.echoes[i] != EchoKind::crosstalk) continue;
      ++hits;
      const bool follows = i > 0 && scan.echoes[i - 1] == EchoKind::crosstalk;
      bursts += follows ? 0 : 1;
      steps += follows && std::abs(length(point_of(scan, i)) - length(point_of(scan, i - 1))) < 2;
    }
  }

  EXPECT_NEAR(hits / (5 * beams_ahead), 0.1, 0.01);
  EXPECT_GT(hits, 2 * bursts);
  EXPECT_GT(steps, 0.9 * (hits - bursts));
}

TEST(Returns, LostBlocksAreCompleteAndMatchTheirRate) {
  Mesh objects;
  add_wall(objects, 10, wall);
  Noise noise = no_noise();
  noise.block_loss_rate = 0.05;
  const Scene scene = flat_scene(objects);
  double lost = 0;
  double beginnings = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const SimulatedScan scan = simulate(scene, sensor_ahead(20, 1000), noise, above_origin(1.5),
                                        seed, {.keep_no_returns = true});
    lost += count(scan, EchoKind::none);
    for (std::size_t i = 1; i < scan.size(); ++i) {
      beginnings += scan.echoes[i] == EchoKind::none && scan.echoes[i - 1] != EchoKind::none;
    }
  }

  EXPECT_NEAR(lost / (10 * beams_ahead), 0.05, 0.01);
  EXPECT_GT(lost, 15 * beginnings);
}

TEST(Returns, MissingReturnsAreKeptAtTheOriginOnRequest) {
  Mesh objects;
  add_wall(objects, 50, wall);
  const Scene scene = flat_scene(objects);
  const Sensor sensor = sensor_ahead(20, 100);

  const SimulatedScan without = simulate(scene, sensor, Noise{}, above_origin(1.5), 1);
  const SimulatedScan with =
      simulate(scene, sensor, Noise{}, above_origin(1.5), 1, {.keep_no_returns = true});

  ASSERT_EQ(with.size(), 2'000U);
  ASSERT_LT(without.size(), with.size());
  std::vector<float> echoes;
  for (std::size_t i = 0; i < with.size(); ++i) {
    const auto first = with.xyzi.begin() + static_cast<std::ptrdiff_t>(4 * i);
    if (with.echoes[i] != EchoKind::none) {
      echoes.insert(echoes.end(), first, first + 4);
      continue;
    }
    ASSERT_EQ(std::vector<float>(first, first + 4), std::vector<float>(4, 0.0F));
    ASSERT_EQ(with.classes[i], 0U);
  }
  EXPECT_EQ(echoes, without.xyzi);
}

}  // namespace
}  // namespace flagstone::sim
