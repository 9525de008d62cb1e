// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "files/render/picture.hpp"
#include "files/render/scale.hpp"

namespace flagstone::render {
namespace {

using testing::ElementsAre;

PatchworkConfig config_to(float last_ring) {
  PatchworkConfig config;
  config.zones = {{.ring_radii = {5, last_ring}}};
  return config;
}

TEST(SuitableRange, IsRoundedUpToTenMetres) {
  LabelledScan scan;
  scan.add(30, 40, 0, Label::ground);
  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), nullptr), 50);
  scan.add(0, -50.1f, 0, Label::nonground);
  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), nullptr), 60);
}

TEST(SuitableRange, IgnoresAFewDistantPoints) {
  LabelledScan scan;
  for (int i = 0; i < 99; ++i) scan.add(15, 0, 0, Label::ground);
  scan.add(1e30f, 0, 0, Label::nonground);

  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), nullptr), 20);
}

TEST(SuitableRange, IgnoresInvalidPoints) {
  LabelledScan scan;
  scan.add(15, 0, 0, Label::ground);
  for (int i = 0; i < 50; ++i) scan.add(900, 0, 0, Label::invalid);
  for (int i = 0; i < 50; ++i)
    scan.add(std::numeric_limits<float>::quiet_NaN(), 0, 0, Label::nonground);

  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), nullptr), 20);
}

TEST(SuitableRange, IsAtMostTheLastRing) {
  const PatchworkConfig config = config_to(80);
  LabelledScan scan;
  scan.add(500, 0, 0, Label::out_of_range);

  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), &config), 80);
}

TEST(SuitableRange, IsAtMostOneKilometreWithoutZones) {
  LabelledScan scan;
  scan.add(1e38f, 1e38f, 0, Label::out_of_range);

  EXPECT_EQ(suitable_range(scan.cloud(), scan.result.labels(), nullptr), 1000);
}

TEST(SuitableRange, CoversTheZonesWithoutPoints) {
  const PatchworkConfig config = config_to(120);
  EXPECT_EQ(suitable_range({}, {}, &config), 120);
  EXPECT_EQ(suitable_range({}, {}, nullptr), 50);
}

TEST(RingStep, IsRoundWithRoomForThreeRings) {
  EXPECT_EQ(ring_step(30), 10);
  EXPECT_EQ(ring_step(50), 10);
  EXPECT_EQ(ring_step(60), 20);
  EXPECT_EQ(ring_step(80), 20);
  EXPECT_EQ(ring_step(1000), 200);
}

RC_GTEST_PROP(RingStep, HasRoomForThreeToSevenRingsAtAnyRange, ()) {
  const double range = *rc::gen::inRange(10, 10001) / 10.0;

  const double rings = range / ring_step(range);

  RC_ASSERT(rings > 3 - 1e-9);
  RC_ASSERT(rings < 7.5 + 1e-9);
}

TEST(CircleRadii, AreRoundDistancesWithoutZones) {
  EXPECT_THAT(circle_radii(30, nullptr), ElementsAre(10, 20, 30, 40, 50));
}

TEST(CircleRadii, AreTheOuterRadiiOfTheZonesIfGiven) {
  PatchworkConfig config = config_to(10);
  config.min_range = 2;
  config.zones.push_back({.ring_radii = {15, 20}});

  EXPECT_THAT(circle_radii(30, &config), ElementsAre(2, 10, 20));
}

}  // namespace
}  // namespace flagstone::render
