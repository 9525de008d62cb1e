// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/grid.hpp"
#include "library/surface/owned_grid.hpp"

namespace flagstone::surface {
namespace {

using tests::OwnedGrid;

/// The height of a grid at a position: bilinear between centres, constant beyond the outermost
/// centres.
double bilinear(OwnedGrid& grid, double x, double y) {
  const auto width = static_cast<double>(grid.grid().width);
  const auto split = [&](double v) {
    const double index =
        std::clamp(v / static_cast<double>(grid.grid().cell) + (width - 1) / 2, 0.0, width - 1);
    const double first = std::min(std::floor(index), width - 2);
    return std::pair(static_cast<std::size_t>(first), index - first);
  };
  const auto [column, share_x] = split(x);
  const auto [row, share_y] = split(y);
  const auto at = [&](std::size_t r, std::size_t c) { return static_cast<double>(grid.at(r, c)); };
  return (1 - share_y) * ((1 - share_x) * at(row, column) + share_x * at(row, column + 1)) +
         share_y * ((1 - share_x) * at(row + 1, column) + share_x * at(row + 1, column + 1));
}

/// The parameter is the instruction set.
class GridSteps : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, GridSteps, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(GridSteps, AFinerGridStartsFromTheInterpolatedCoarserGrid) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> height(-2, 2);
  for (const auto& [coarse_width, fine_width] :
       {std::pair(16, 32), std::pair(16, 16), std::pair(104, 80), std::pair(8, 16),
        std::pair(8, 4)}) {
    OwnedGrid coarse(2, static_cast<std::size_t>(coarse_width));
    OwnedGrid fine(1, static_cast<std::size_t>(fine_width));
    for (float& value : coarse.heights()) value = height(random);
    for (float& value : coarse.confidences()) value = std::abs(height(random)) / 2;

    upsample(coarse.grid(), fine.grid());

    OwnedGrid confidences(2, static_cast<std::size_t>(coarse_width));
    confidences.heights() = coarse.confidences();
    for (std::size_t row = 0; row < fine.grid().width; ++row) {
      for (std::size_t column = 0; column < fine.grid().width; ++column) {
        const auto x = static_cast<double>(fine.grid().center(column));
        const auto y = static_cast<double>(fine.grid().center(row));
        const std::size_t i = row * fine.grid().width + column;
        ASSERT_NEAR(fine.heights()[i], bilinear(coarse, x, y), 1e-6) << x << ", " << y;
        ASSERT_NEAR(fine.confidences()[i], bilinear(confidences, x, y), 1e-6);
      }
    }
  }
}

TEST_P(GridSteps, InterpolationPreservesAPlane) {
  const auto plane = [](float x, float y) { return -1.7f + 0.125f * x - 0.25f * y; };
  OwnedGrid coarse(2, 52);
  OwnedGrid fine(1, 80);
  coarse.set(plane);

  upsample(coarse.grid(), fine.grid());

  for (std::size_t row = 0; row < 80; ++row) {
    for (std::size_t column = 0; column < 80; ++column) {
      const float expected = plane(fine.grid().center(column), fine.grid().center(row));
      ASSERT_NEAR(fine.at(row, column), expected, 2e-6f);
    }
  }
}

/// Adds corrections to a grid. A weight of 1 is full.
void correct(std::vector<float>& corrections, std::vector<float>& weights, bool inner,
             const Grid& grid) {
  PullPush(grid.width).correct(corrections.data(), weights.data(), 1, inner, grid);
}

TEST_P(GridSteps, CorrectionsAreAdded) {
  OwnedGrid grid(1, 20, -1.5f);
  std::vector<float> corrections(400, 0.25f);
  std::vector<float> weights(400, 1.0f);

  correct(corrections, weights, false, grid.grid());

  EXPECT_EQ(grid.heights(), std::vector<float>(400, -1.25f));
}

TEST_P(GridSteps, CorrectionsAreFilledFirst) {
  for (const std::size_t width : {2U, 6U, 20U, 80U, 96U}) {
    const std::size_t size = width * width;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(0, 1);
    OwnedGrid grid(1, width);
    std::vector<float> corrections(size, 0.0f);
    std::vector<float> weights(size, 0.0f);
    for (std::size_t i = 0; i < size; ++i) {
      grid.heights()[i] = number(random) - 2;
      grid.confidences()[i] = number(random);
      if (i % 3 == 0) continue;
      corrections[i] = number(random) - 0.5f;
      weights[i] = 2 * number(random);
    }
    std::vector<float> filled = corrections;
    std::vector<float> confidences = weights;
    PullPush(width).fill(filled.data(), confidences.data(), width, 1);
    std::vector<float> heights = grid.heights();
    for (std::size_t i = 0; i < size; ++i) {
      heights[i] += filled[i];
      confidences[i] = std::max(confidences[i], grid.confidences()[i]);
    }

    correct(corrections, weights, false, grid.grid());

    EXPECT_EQ(grid.heights(), heights);
    EXPECT_EQ(grid.confidences(), confidences);
    EXPECT_EQ(corrections, std::vector<float>(size, 0.0f));
    EXPECT_EQ(weights, std::vector<float>(size, 0.0f));
  }
}

TEST_P(GridSteps, CorrectionsFadeToZeroAtAnInnerEdge) {
  for (const std::size_t width : {2U, 4U, 6U, 20U}) {
    OwnedGrid grid(1, width);
    std::vector<float> corrections(width * width, 1.0f);
    std::vector<float> weights(width * width, 1.0f);

    correct(corrections, weights, true, grid.grid());

    const std::size_t last = width - 1;
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t k = 0; k < width; ++k) {
        // Symmetric on all sides.
        ASSERT_EQ(grid.at(i, k), grid.at(k, i));
        ASSERT_EQ(grid.at(i, k), grid.at(last - i, k));
        if (k > 0 && 2 * k < width) {
          ASSERT_GE(grid.at(i, k), grid.at(i, k - 1));
        }
      }
      EXPECT_EQ(grid.at(0, i), 0);
    }
    if (width == 20) {
      EXPECT_EQ(grid.at(10, 10), 1);
    }
  }
}

}  // namespace
}  // namespace flagstone::surface
