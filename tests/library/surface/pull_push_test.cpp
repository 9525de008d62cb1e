// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/grid.hpp"

namespace flagstone::surface {
namespace {

/// A square grid in double precision.
struct WideGrid {
  std::size_t width;
  std::vector<double> values, weights;

  /// Indices beyond the edge refer to the outermost cell.
  [[nodiscard]] std::size_t index(std::ptrdiff_t row, std::ptrdiff_t column) const {
    const auto last = static_cast<std::ptrdiff_t>(width) - 1;
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row, 0, last)) * width +
           static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(column, 0, last));
  }
};

/// A naive implementation of pull-push, following the paper and the header.
void fill_naively(WideGrid& grid, double full) {
  const std::size_t width = grid.width;
  if (width == 1) {
    grid.weights[0] = std::min(1.0, grid.weights[0] / full);
    return;
  }
  const std::size_t half = (width + 1) / 2;
  WideGrid coarse{.width = half,
                  .values = std::vector<double>(half * half),
                  .weights = std::vector<double>(half * half)};
  for (std::size_t row = 0; row < width; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t parent = row / 2 * half + column / 2;
      const double weight = std::min(full, grid.weights[row * width + column]);
      coarse.values[parent] += weight * grid.values[row * width + column];
      coarse.weights[parent] += weight;
    }
  }
  for (std::size_t i = 0; i < half * half; ++i) {
    coarse.values[i] = coarse.weights[i] > 0 ? coarse.values[i] / coarse.weights[i] : 0;
  }
  fill_naively(coarse, full);
  for (std::size_t row = 0; row < width; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      // Bilinear between the centres of coarse cells.
      double value = 0;
      double confidence = 0;
      const auto r = static_cast<std::ptrdiff_t>(row / 2);
      const auto c = static_cast<std::ptrdiff_t>(column / 2);
      const std::ptrdiff_t beside_r = row % 2 == 0 ? r - 1 : r + 1;
      const std::ptrdiff_t beside_c = column % 2 == 0 ? c - 1 : c + 1;
      for (const auto& [y, share_y] : {std::pair(r, 0.75), std::pair(beside_r, 0.25)}) {
        for (const auto& [x, share_x] : {std::pair(c, 0.75), std::pair(beside_c, 0.25)}) {
          value += share_y * share_x * coarse.values[coarse.index(y, x)];
          confidence += share_y * share_x * coarse.weights[coarse.index(y, x)];
        }
      }
      const std::size_t i = row * width + column;
      const double known = std::min(1.0, grid.weights[i] / full);
      grid.values[i] = known * grid.values[i] + (1 - known) * value;
      grid.weights[i] = known + (1 - known) * confidence / 2;
    }
  }
}

/// The parameter is the instruction set.
class PullPushOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, PullPushOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(PullPushOn, MatchesANaiveImplementationAtAnyEvenWidth) {
  PullPush pull_push(104);
  EXPECT_TRUE(rc::check([&] {
    const auto width = 2 * *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 20),
                                           rc::gen::element<std::size_t>(40, 48, 52));
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    const auto gaps = *rc::gen::inRange<std::uint32_t>(0, 100);  // percent
    const float full = *rc::gen::element(0.5f, 200.0f);
    std::uniform_real_distribution<float> height(-3, 3);
    std::uniform_real_distribution<float> weight(0, 2 * full);
    std::vector<float> values(width * width);
    std::vector<float> weights(width * width);
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = height(random);
      weights[i] = random() % 100 < gaps ? 0 : weight(random);
    }
    WideGrid wide{.width = width,
                  .values = {values.begin(), values.end()},
                  .weights = {weights.begin(), weights.end()}};

    fill_naively(wide, static_cast<double>(full));
    pull_push.fill(values.data(), weights.data(), width, full);

    for (std::size_t i = 0; i < values.size(); ++i) {
      RC_ASSERT(std::abs(static_cast<double>(values[i]) - wide.values[i]) < 2e-5);
      RC_ASSERT(std::abs(static_cast<double>(weights[i]) - wide.weights[i]) < 2e-6);
    }
  }));
}

TEST_P(PullPushOn, CellsWithFullWeightKeepTheirExactValue) {
  constexpr std::size_t width = 30;
  PullPush pull_push(width);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> height(-3, 3);
  std::vector<float> values(width * width);
  std::vector<float> weights(width * width);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = height(random);
    weights[i] = i % 3 == 0 ? 0.5f : 0.1f;
  }
  const std::vector<float> before = values;

  pull_push.fill(values.data(), weights.data(), width, 0.5f);

  for (std::size_t i = 0; i < values.size(); i += 3) {
    EXPECT_EQ(values[i], before[i]);
    EXPECT_EQ(weights[i], 1);
  }
}

TEST_P(PullPushOn, WithoutWeightsAllValuesAreZero) {
  constexpr std::size_t width = 26;
  PullPush pull_push(width);
  std::vector<float> values(width * width, 7.0f);
  std::vector<float> weights(width * width, 0.0f);

  pull_push.fill(values.data(), weights.data(), width, 0.5f);

  EXPECT_EQ(values, std::vector<float>(width * width, 0.0f));
  EXPECT_EQ(weights, std::vector<float>(width * width, 0.0f));
}

TEST_P(PullPushOn, OneKnownCellFillsTheGridWithDecreasingConfidence) {
  constexpr std::size_t width = 64;
  PullPush pull_push(width);
  std::vector<float> values(width * width, 0.0f);
  std::vector<float> weights(width * width, 0.0f);
  values[0] = -1.5f;
  weights[0] = 0.5f;

  pull_push.fill(values.data(), weights.data(), width, 0.5f);

  for (const float value : values) EXPECT_NEAR(value, -1.5f, 1e-6f);
  for (std::size_t i = 1; i < width; ++i) EXPECT_LE(weights[i], weights[i - 1]);
  EXPECT_LT(weights.back(), weights[1]);
  EXPECT_GT(weights.back(), 0);
}

TEST_P(PullPushOn, KeepsNoStateBetweenGrids) {
  PullPush used(40);
  std::vector<float> values(1600, 100.0f);
  std::vector<float> weights(1600, 1.0f);
  used.fill(values.data(), weights.data(), 40, 0.5f);
  std::vector<float> some(400, 1.0f);
  std::vector<float> of_some(400, 0.0f);
  of_some[210] = 0.25f;
  std::vector<float> same = some;
  std::vector<float> of_same = of_some;

  used.fill(some.data(), of_some.data(), 20, 0.5f);
  PullPush(20).fill(same.data(), of_same.data(), 20, 0.5f);

  EXPECT_EQ(some, same);
  EXPECT_EQ(of_some, of_same);
}

}  // namespace
}  // namespace flagstone::surface
