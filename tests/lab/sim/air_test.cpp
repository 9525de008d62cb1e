// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "lab/sim/beams.hpp"
#include "lab/sim/flat_scene.hpp"
#include "lab/sim/measurement.hpp"

namespace flagstone::sim {
namespace {

Noise dusty(double extinction) {
  Noise noise = no_noise();
  noise.dust_clouds = 8;
  noise.dust_extinction = extinction;
  return noise;
}

// A level road and a sensor on it.
struct Place {
  Sensor sensor = sensor_ahead(1, 1);
  Scene scene = flat_scene();
  Surroundings surroundings{scene, nullptr};
  Frame pose = above_origin(1.5);
};

// A level beam in this direction.
Vector3 level(int degrees) {
  const double angle = degrees * 3.14159265358979 / 180;
  return {std::cos(angle), std::sin(angle), 0};
}

TEST(Air, DustReturnsTheLightThatItDoesNotTransmit) {
  const Place place;
  const Noise noise = dusty(0.15);
  const Air air(noise, place.sensor, place.surroundings, place.pose, 1);
  constexpr double way = 60;
  constexpr int draws = 2'000;
  int through_dust = 0;
  for (int degrees = 0; degrees < 360; degrees += 5) {
    const double let_through = air.transmission(place.pose.origin, level(degrees), way);
    through_dust += let_through < 0.99;
    Random random(static_cast<std::uint64_t>(degrees));
    double sent_back = 0;
    for (int i = 0; i < draws; ++i) {
      const auto echo = air.echo(place.pose.origin, level(degrees), way, random);
      sent_back += echo.has_value();
      if (echo) {
        ASSERT_EQ(echo->kind, EchoKind::dust);
      }
    }
    EXPECT_NEAR(sent_back / draws, 1 - let_through, 0.05) << degrees << " degrees";
  }
  EXPECT_GT(through_dust, 10);
}

TEST(Air, DustCloudIsBehindTheVehicle) {
  const Place place;
  Noise noise = dusty(0.5);
  noise.dust_clouds = 1;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Air air(noise, place.sensor, place.surroundings, place.pose, seed);

    EXPECT_EQ(air.transmission(place.pose.origin, level(0), 60), 1);
    EXPECT_LT(air.transmission(place.pose.origin, level(180), 60), 0.9);
  }
}

TEST(Air, ClearAirHasNoEffect) {
  const Place place;
  const Noise noise{};
  const Air air(noise, place.sensor, place.surroundings, place.pose, 1);
  Random random(1);
  for (int degrees = 0; degrees < 360; ++degrees) {
    EXPECT_EQ(air.transmission(place.pose.origin, level(degrees), 60), 1);
    EXPECT_FALSE(air.echo(place.pose.origin, level(degrees), 60, random));
  }
}

TEST(Air, ReturnsAreNoFartherThanTheEndOfTheBeam) {
  const Place place;
  Noise noise = dusty(2);
  noise.rain_rate = 0.5;
  const Air air(noise, place.sensor, place.surroundings, place.pose, 2);
  Random random(7);
  for (int degrees = 0; degrees < 360; ++degrees) {
    for (const double way : {1.2, 4.0, 11.0, 40.0}) {
      const auto echo = air.echo(place.pose.origin, level(degrees), way, random);
      if (echo) {
        ASSERT_LT(echo->range, way);
      }
    }
  }
}

}  // namespace
}  // namespace flagstone::sim
