// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/patch_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "numbers.hpp"

namespace flagstone::surface {
namespace {

/// A plane through many points at (x, 0, z), tilted by `tilt` degrees.
Plane ahead(double x, double z, double tilt = 0) {
  const double angle = tilt * 3.14159265358979 / 180;
  Plane plane{.count = 100, .mean = {x, 0, z}};
  plane.normal = {std::sin(angle), 0, std::cos(angle)};
  plane.d = -(plane.normal[0] * x + plane.normal[2] * z);
  return plane;
}

constexpr SlabCounts clear{.within = 100, .above = 0};

FittedPatch level_at(float x, float z) {
  return {.x = x, .y = 0, .z = z, .slope_x = 0, .slope_y = 0, .points = 100};
}

TEST(PatchJudge, LevelPatchesAtTheSensorHeightAreGround) {
  EXPECT_EQ(PatchJudge({}).judge_alone(ahead(10, -1.73), clear), Verdict::ground);
}

TEST(PatchJudge, TooFewPointsGiveNoPlane) {
  Plane plane = ahead(10, -1.73);
  plane.count = 4;

  EXPECT_EQ(PatchJudge({}).judge_alone(plane, clear), Verdict::no_plane);
}

TEST(PatchJudge, SteepPatchesAreNotUpright) {
  SurfaceConfig config;
  config.acceptance.upright_angle = 60;  // between normal and ground: a tilt of 30 degrees
  const PatchJudge judge(config);
  constexpr SlabCounts rough{.within = 100, .above = 6};

  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73, -29.9), rough), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73, -30.1), rough), Verdict::not_upright);
}

TEST(PatchJudge, ClearPatchesCanBeSteeper) {
  SurfaceConfig config;
  config.acceptance.upright_angle = 60;
  const PatchJudge judge(config);
  constexpr SlabCounts almost_clear{.within = 100, .above = 5};

  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73, -38.6), almost_clear), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73, -38.8), almost_clear), Verdict::not_upright);
}

TEST(PatchJudge, SteepPatchesNeedANeighbourThatAgrees) {
  const PatchJudge judge({});  // a slope of 0.75 is steep
  FittedPatch bank = level_at(16, -1.73f);
  bank.slope_x = 0.8f;
  AcceptedPatches patches;
  patches.reserve(1);

  EXPECT_EQ(judge.judge_step(bank, patches), Verdict::off_surface);
  patches.add(level_at(12, -1.73f));
  EXPECT_EQ(judge.judge_step(bank, patches), Verdict::ground);
  bank.z += 0.375f * 0.8f * 4 + 0.69f;  // 0.5 + 0.05 * 4 above the curve
  EXPECT_EQ(judge.judge_step(bank, patches), Verdict::ground);
  bank.z += 0.02f;
  EXPECT_EQ(judge.judge_step(bank, patches), Verdict::off_surface);
}

TEST(PatchJudge, AWallIsNeverGround) {
  SurfaceConfig config;
  config.acceptance.upright_angle = 0;

  EXPECT_EQ(PatchJudge(config).judge_alone(ahead(10, -1.73, 90), clear), Verdict::not_upright);
  EXPECT_EQ(PatchJudge(config).judge_alone(ahead(10, -1.73, -80), clear), Verdict::ground);
}

TEST(PatchJudge, PatchesWithTooManyPointsAboveThemAreMixed) {
  SurfaceConfig config;
  config.acceptance.max_clutter_ratio = 0.5f;
  const PatchJudge judge(config);

  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73), {.within = 100, .above = 50}), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(10, -1.73), {.within = 100, .above = 51}), Verdict::mixed);
}

TEST(PatchJudge, WithoutALimitNothingIsMixed) {
  SurfaceConfig config;
  config.acceptance.max_clutter_ratio = inf;

  EXPECT_EQ(PatchJudge(config).judge_alone(ahead(10, -1.73), {.within = 0, .above = 100}),
            Verdict::ground);
}

TEST(PatchJudge, PatchesAboveTheHeightLimitAreTooHigh) {
  SurfaceConfig config;
  config.sensor_height = 5;
  config.acceptance.max_height = 1;
  config.acceptance.max_slope = 0.2f;
  const PatchJudge judge(config);

  // The limit is -5 + 1 near the sensor and -5 + 0.2 * 20 at 20 m.
  EXPECT_EQ(judge.judge_alone(ahead(4, -4.01), clear), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(4, -3.99), clear), Verdict::too_high);
  EXPECT_EQ(judge.judge_alone(ahead(20, -1.01), clear), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(20, -0.99), clear), Verdict::too_high);
}

TEST(PatchJudge, PatchesAreNotGroundIfTheSensorIsBelowTheirPlane) {
  const PatchJudge judge({});

  // A level plane at 20 m may be 0.02 * 20 m above the sensor.
  EXPECT_EQ(judge.judge_alone(ahead(20, 0.39), clear), Verdict::ground);
  EXPECT_EQ(judge.judge_alone(ahead(20, 0.41), clear), Verdict::too_high);
  // A hillside that faces the sensor is visible.
  EXPECT_EQ(judge.judge_alone(ahead(20, 4, -15), clear), Verdict::ground);
}

TEST(PatchJudge, TheSensorIsAboveTheOriginIfTheOriginIsOnTheGround) {
  SurfaceConfig config;
  config.sensor_height = 0;

  EXPECT_EQ(PatchJudge(config).judge_alone(ahead(20, 1.4), clear), Verdict::ground);
  EXPECT_EQ(PatchJudge(config).judge_alone(ahead(20, 2.2), clear), Verdict::too_high);
}

TEST(PatchJudge, TheFirstPatchIsComparedWithTheSensorHeight) {
  SurfaceConfig config;
  config.acceptance.max_step = 0.5f;
  config.acceptance.max_step_per_metre = 0.1f;
  const PatchJudge judge(config);
  AcceptedPatches none;
  none.reserve(1);

  // At 5 m the allowed step is 0.5 upwards, and 0.5 + 0.1 * 5 + 0.5 downwards.
  EXPECT_EQ(judge.judge_step(level_at(5, -1.73f + 0.49f), none), Verdict::ground);
  EXPECT_EQ(judge.judge_step(level_at(5, -1.73f + 0.51f), none), Verdict::off_surface);
  EXPECT_EQ(judge.judge_step(level_at(5, -1.73f - 1.49f), none), Verdict::ground);
  EXPECT_EQ(judge.judge_step(level_at(5, -1.73f - 1.51f), none), Verdict::off_surface);
}

TEST(PatchJudge, TheFirstPatchCanLieOnARisingCurve) {
  AcceptedPatches none;
  none.reserve(1);
  FittedPatch bank = level_at(10, -1.73f + 1.0f);
  bank.slope_x = 0.2f;  // rises 0.75 / 2 * 0.2 * 10 m above level ground

  EXPECT_EQ(PatchJudge({}).judge_step(bank, none), Verdict::ground);
  EXPECT_EQ(PatchJudge({}).judge_step(level_at(10, -1.73f + 1.0f), none), Verdict::off_surface);
}

TEST(PatchJudge, LaterPatchesAreComparedWithNearerOnes) {
  SurfaceConfig config;
  config.acceptance.max_step = 0.5f;
  config.acceptance.max_step_per_metre = 0.1f;
  const PatchJudge judge(config);
  AcceptedPatches nearer;
  nearer.reserve(1);
  nearer.add(level_at(16, 3));

  // At 4 m from the neighbour the allowed step is 0.5 + 0.1 * 4 upwards.
  EXPECT_EQ(judge.judge_step(level_at(20, 3.89f), nearer), Verdict::ground);
  EXPECT_EQ(judge.judge_step(level_at(20, 3.91f), nearer), Verdict::off_surface);
  EXPECT_EQ(judge.judge_step(level_at(20, -1.73f), nearer), Verdict::off_surface);
}

TEST(PatchJudge, TheAllowedStepStopsIncreasingAt15Metres) {
  SurfaceConfig config;
  config.acceptance.max_step = 0.5f;
  config.acceptance.max_step_per_metre = 0.1f;
  const PatchJudge judge(config);
  AcceptedPatches nearer;
  nearer.reserve(1);
  nearer.add(level_at(60, -1.73f));

  EXPECT_EQ(judge.judge_step(level_at(80, -1.73f + 1.99f), nearer), Verdict::ground);
  EXPECT_EQ(judge.judge_step(level_at(80, -1.73f + 2.01f), nearer), Verdict::off_surface);
}

TEST(PatchJudge, WithoutALimitEveryStepIsGround) {
  SurfaceConfig config;
  config.acceptance.max_step = inf;
  AcceptedPatches none;
  none.reserve(1);

  EXPECT_EQ(PatchJudge(config).judge_step(level_at(5, 900), none), Verdict::ground);
  EXPECT_EQ(PatchJudge(config).judge_step(level_at(5, -900), none), Verdict::ground);
}

}  // namespace
}  // namespace flagstone::surface
