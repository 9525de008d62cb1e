// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/ground_map/level_fit.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "library/core/random.hpp"

namespace flagstone {
namespace {

std::vector<HeightDifference> cells_with(
    const std::function<double(double x, double y)>& difference, int side = 40) {
  std::vector<HeightDifference> cells;
  for (int j = -side; j <= side; ++j) {
    for (int i = -side; i <= side; ++i) {
      const double x = 0.5 * i;
      const double y = 0.5 * j;
      cells.push_back({.dx = x, .dy = y, .difference = difference(x, y)});
    }
  }
  return cells;
}

Levelling fitted(const std::vector<HeightDifference>& cells, double max_correction = 1) {
  std::vector<double> memory;
  return fit_level(cells, {}, max_correction, memory);
}

TEST(LevelFit, FindsThePlane) {
  const Levelling fit =
      fitted(cells_with([](double x, double y) { return 0.2 + 0.01 * x - 0.02 * y; }));

  EXPECT_TRUE(fit.applied);
  EXPECT_NEAR(fit.offset, 0.2, 1e-3);
  EXPECT_NEAR(fit.slope_x, 0.01, 1e-4);
  EXPECT_NEAR(fit.slope_y, -0.02, 1e-4);
}

TEST(LevelFit, IgnoresCellsThatContradictTheOthers) {
  Random random(1);
  const Levelling fit = fitted(cells_with([&](double x, double) {
    const bool is_wrong = random.chance(0.4);
    return is_wrong ? random.uniform(0.5, 2) : 0.1 + 0.005 * x + 0.01 * random.normal();
  }));

  EXPECT_TRUE(fit.applied);
  EXPECT_NEAR(fit.offset, 0.1, 0.005);
  EXPECT_NEAR(fit.slope_x, 0.005, 0.0005);
}

TEST(LevelFit, NeedsAHundredCells) {
  const auto difference = [](double, double) { return 0.2; };

  EXPECT_FALSE(fitted(cells_with(difference, 4)).applied);  // 81
  EXPECT_TRUE(fitted(cells_with(difference, 5)).applied);   // 121
  EXPECT_EQ(fitted(cells_with(difference, 4)).cells, 81U);
  EXPECT_FALSE(fitted({}).applied);
}

TEST(LevelFit, IsNotAppliedBeyondTheMaxCorrectionOrIfSteep) {
  EXPECT_TRUE(fitted(cells_with([](double, double) { return 0.9; })).applied);
  EXPECT_FALSE(fitted(cells_with([](double, double) { return 1.1; })).applied);
  EXPECT_FALSE(fitted(cells_with([](double x, double) { return 0.3 * x; })).applied);
}

TEST(LevelFit, IsComparedWithTheExpectedPlane) {
  const auto cells = cells_with([](double x, double) { return 2.5 + 0.01 * x; });
  std::vector<double> memory;

  const Levelling near = fit_level(cells, {.offset = 1.8}, 1, memory);
  const Levelling far = fit_level(cells, {.offset = 1.2, .slope_y = 0.02}, 1, memory);

  EXPECT_TRUE(near.applied);
  EXPECT_NEAR(near.offset, 2.5, 1e-3);
  EXPECT_FALSE(far.applied);
  EXPECT_EQ(far.offset, 1.2);
  EXPECT_EQ(far.slope_y, 0.02);
}

}  // namespace
}  // namespace flagstone
