// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/patchwork/ground_likelihood.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace flagstone::patchwork {
namespace {

/// A plane of at least three points with the values that the likelihood uses.
Plane plane(double normal_z, double mean_z, double sigma) {
  Plane plane;
  plane.count = 100;
  plane.normal = {std::sqrt(1 - normal_z * normal_z), 0, normal_z};
  plane.mean = {5, 0, mean_z};
  plane.eigenvalues = {(1 - sigma) / 2, (1 - sigma) / 2, sigma};
  return plane;
}

Patch judged(const PatchworkConfig& config, const Plane& plane, std::size_t ring = 0) {
  const ConcentricZones zones(config);
  Patch patch;
  GroundLikelihood(config, zones.rings()).judge(plane, ring, patch);
  return patch;
}

/// kappa(r_n) of the innermost ring of a configuration.
double kappa(const PatchworkConfig& config) {
  const double r = ConcentricZones(config).rings()[0].center_radius;
  return -config.sensor_height + config.elevation.base * std::exp(config.elevation.growth * r);
}

const PatchworkConfig paper = PatchworkConfig::preset("paper");
const PatchworkConfig reference = PatchworkConfig::preset("reference");

TEST(Uprightness, RequiresANormalMoreThan45DegreesFromTheGround) {
  EXPECT_EQ(judged(paper, plane(0.708, -1.7, 0.001)).verdict, Verdict::ground);
  const Patch leaning = judged(paper, plane(0.706, -1.7, 0.001));
  EXPECT_EQ(leaning.verdict, Verdict::not_upright);
  EXPECT_EQ(leaning.uprightness, 0);
  EXPECT_EQ(leaning.likelihood, 0);
}

TEST(Uprightness, CanBeDisabled) {
  PatchworkConfig config = paper;
  config.uprightness.enabled = false;

  EXPECT_EQ(judged(config, plane(0.1, -1.7, 0.001)).verdict, Verdict::ground);
}

TEST(Elevation, IsTheLogisticFunctionOfEquation10) {
  const Patch patch = judged(paper, plane(1, -1.0, 0.001));

  EXPECT_NEAR(patch.elevation, 1 / (1 + std::exp(-1.0 - kappa(paper))), 1e-6);
}

TEST(Elevation, RejectsPatchesAboveItsMidpoint) {
  PatchworkConfig config = paper;
  config.flatness.enabled = false;

  EXPECT_EQ(judged(config, plane(1, kappa(config) - 0.01, 0.001)).verdict, Verdict::ground);
  EXPECT_EQ(judged(config, plane(1, kappa(config) + 0.01, 0.001)).verdict, Verdict::too_high);
}

TEST(Elevation, IsOneHalfAtItsMidpointWhichIsNotGround) {
  PatchworkConfig config = paper;
  config.elevation.base = 0;  // so that kappa is -h_s, exactly

  const Patch patch = judged(config, plane(1, -double{config.sensor_height}, 1e-6));

  EXPECT_EQ(patch.elevation, 0.5f);
  EXPECT_EQ(patch.flatness, 1);  // psi < 0.5 in eq. (11), not <=
  EXPECT_EQ(patch.likelihood, 0.5f);
  EXPECT_EQ(patch.verdict, Verdict::too_high);  // f > 0.5 in eq. (12), not >=
}

TEST(Elevation, TestsOnlyRingsNearerThanItsRange) {
  PatchworkConfig config = paper;
  config.elevation.range = ConcentricZones(config).rings()[0].center_radius;
  EXPECT_EQ(judged(config, plane(1, 3, 0.1)).elevation, 1);  // r_n < L_tau in eq. (10), not <=

  config.elevation.range = std::nextafter(config.elevation.range, 100.0f);
  EXPECT_LT(judged(config, plane(1, 3, 0.1)).elevation, 0.5f);
}

TEST(Elevation, CanBeDisabled) {
  PatchworkConfig config = paper;
  config.elevation.enabled = false;

  EXPECT_EQ(judged(config, plane(1, 3, 0.1)).verdict, Verdict::ground);
}

TEST(Elevation, DoesNotTestRingsBeyondItsRange) {
  const std::size_t last_ring = ConcentricZones(paper).rings().size() - 1;

  const Patch patch = judged(paper, plane(1, 3, 0.1), last_ring);

  EXPECT_EQ(patch.elevation, 1);
  EXPECT_EQ(patch.verdict, Verdict::ground);
}

TEST(Elevation, MatchesTheStepsOfThePublicCode) {
  // 0.523, 0.746, 0.879 and 1.125 m above -h_s in the first four rings
  const ConcentricZones zones(reference);
  constexpr std::array steps = {0.523, 0.746, 0.879, 1.125};
  for (std::size_t ring = 0; ring < 4; ++ring) {
    const double r = zones.rings()[ring].center_radius;
    EXPECT_LT(r, reference.elevation.range);
    EXPECT_NEAR(reference.elevation.base * std::exp(reference.elevation.growth * r), steps[ring],
                0.06);
  }
  EXPECT_GT(zones.rings()[4].center_radius, reference.elevation.range);
}

TEST(Elevation, BecomesAStepAsItsScaleShrinks) {
  PatchworkConfig config = paper;
  config.flatness.enabled = false;
  config.elevation.scale = 1e-6f;

  EXPECT_EQ(judged(config, plane(1, kappa(config) - 1e-3, 0.001)).elevation, 1);
  EXPECT_EQ(judged(config, plane(1, kappa(config) + 1e-3, 0.001)).elevation, 0);
}

TEST(Flatness, IsTheExponentialOfEquation11IfThePatchIsHigh) {
  const double sigma = 0.01;

  const Patch patch = judged(paper, plane(1, kappa(paper) + 0.5, sigma));

  EXPECT_NEAR(patch.flatness,
              paper.flatness.gain * std::exp(-(sigma - paper.flatness.thresholds[0])), 1e-6);
}

TEST(Flatness, IsOneIfThePatchIsLow) {
  EXPECT_EQ(judged(paper, plane(1, kappa(paper) - 0.5, 0.3)).flatness, 1);
}

TEST(Flatness, AsPrintedAcceptsPatchesThatAreSlightlyTooHigh) {
  // psi > 1 / (2 zeta) is enough: z up to kappa + log(2 zeta - 1)
  const double reach = std::log(2.0 * paper.flatness.gain - 1);

  EXPECT_EQ(judged(paper, plane(1, kappa(paper) + reach - 0.01, 1e-5)).verdict,
            Verdict::ground_flat);
  EXPECT_EQ(judged(paper, plane(1, kappa(paper) + reach + 0.01, 1e-5)).verdict, Verdict::too_high);
}

TEST(Flatness, IsTheStepOfThePublicCodeIfItsScaleIsSmall) {
  const double high = kappa(reference) + 5;

  const Patch even = judged(reference, plane(1, high, 0.0004));
  const Patch rough = judged(reference, plane(1, high, 0.0006));

  EXPECT_EQ(even.verdict, Verdict::ground_flat);
  EXPECT_EQ(rough.verdict, Verdict::too_high);
}

TEST(Flatness, DecidesBySigmaIfItAndElevationAreSteps) {
  PatchworkConfig config = reference;
  config.elevation.scale = 1e-6f;

  EXPECT_EQ(judged(config, plane(1, 2, 0.0004)).verdict, Verdict::ground_flat);
  EXPECT_EQ(judged(config, plane(1, 2, 0.0006)).verdict, Verdict::too_high);
}

TEST(Flatness, CanBeDisabled) {
  PatchworkConfig config = reference;
  config.flatness.enabled = false;

  EXPECT_EQ(judged(config, plane(1, 2, 1e-6)).verdict, Verdict::too_high);
}

TEST(Likelihood, IsTheProductOfItsTerms) {
  const Patch patch = judged(paper, plane(1, kappa(paper) + 0.2, 0.001));

  EXPECT_FLOAT_EQ(patch.likelihood, patch.uprightness * patch.elevation * patch.flatness);
}

}  // namespace
}  // namespace flagstone::patchwork
