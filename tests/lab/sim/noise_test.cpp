// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace flagstone::sim {
namespace {

constexpr std::uint64_t draws = 20'000;

template <class Draw>
double share(Draw draw) {
  double hits = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    Random random = Random::stream(5, i);
    hits += draw(random) ? 1 : 0;
  }
  return hits / draws;
}

TEST(Noise, NoneKeepsRangeAndIntensity) {
  Random random(1);

  EXPECT_EQ(measured_range(no_noise(), Sensor::named("hdl-64e"), 12.5, random), 12.5);
  EXPECT_EQ(measured_intensity(no_noise(), 0.5, 1, random), 0.5);
  EXPECT_TRUE(is_detected(no_noise(), 79, 0.01, 0.01, random));
  EXPECT_FALSE(is_mirrored(no_noise(), 5, random));
}

TEST(Noise, RangeHasTheStandardDeviationOfTheSensor) {
  double squares = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    Random random = Random::stream(9, i);
    const double error = measured_range(Noise{}, Sensor::named("hdl-64e"), 30, random) - 30;
    squares += error * error;
  }

  EXPECT_NEAR(std::sqrt(squares / draws), 0.02, 0.001);
}

TEST(Noise, NearReturnsAreLostOnlyAtTheDropRate) {
  const double detected =
      share([](Random& random) { return is_detected(Noise{}, 3, 0.5, 1, random); });

  EXPECT_NEAR(detected, 1 - Noise{}.drop_rate, 0.01);
}

TEST(Noise, HalfOfTheReturnsAtHalfDetectionStrengthAreLost) {
  const Noise noise{.drop_rate = 0};
  const double range = std::sqrt(0.5 / noise.half_detection);

  const double detected =
      share([&](Random& random) { return is_detected(noise, range, 0.5, 1, random); });

  EXPECT_NEAR(detected, 0.5, 0.02);
}

TEST(Noise, GrazingBeamsAreLostBeforeUprightOnes) {
  const auto detected = [](double incidence) {
    return share([&](Random& random) { return is_detected(Noise{}, 40, 0.24, incidence, random); });
  };

  EXPECT_LT(detected(0.02), detected(0.5) - 0.1);
}

TEST(Noise, IntensityStaysWithinZeroAndOne) {
  const Noise noise{.intensity_sigma = 0.5};
  for (std::uint64_t i = 0; i < draws; ++i) {
    Random random = Random::stream(2, i);
    const double intensity = measured_intensity(noise, 0.9, 1, random);
    ASSERT_GE(intensity, 0);
    ASSERT_LE(intensity, 1);
  }
}

TEST(Noise, SpecularReflectionDecreasesWithRange) {
  const auto mirrored = [](double range) {
    return share(
        [&](Random& random) { return is_mirrored(Noise{.ghost_rate = 1}, range, random); });
  };

  EXPECT_NEAR(mirrored(2), 0.25, 0.02);
  EXPECT_NEAR(mirrored(4), 0.0625, 0.01);
  EXPECT_EQ(mirrored(Noise{}.ghost_max_range + 1), 0);
}

}  // namespace
}  // namespace flagstone::sim
