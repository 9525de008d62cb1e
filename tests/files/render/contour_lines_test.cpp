// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "files/render/contours.hpp"
#include "numbers.hpp"

namespace flagstone::render {
namespace {

using testing::UnorderedElementsAre;

std::vector<float> sampled(std::size_t width, std::size_t rows,
                           const std::function<double(double, double)>& height) {
  std::vector<float> heights;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      heights.push_back(
          static_cast<float>(height(static_cast<double>(column), static_cast<double>(row))));
    }
  }
  return heights;
}

bool is_closed(const ContourLine& line) { return line.front() == line.back(); }

double length_of(const ContourLine& line) {
  double length = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    length += std::hypot(line[i].column - line[i - 1].column, line[i].row - line[i - 1].row);
  }
  return length;
}

/// Equality of lines, traced from either end.
ContourLine from_the_left(ContourLine line) {
  if (line.back().column < line.front().column) std::ranges::reverse(line);
  return line;
}

TEST(ContourLines, AreEmptyIfNoHeightCrossesTheLevel) {
  EXPECT_TRUE(contour_lines(std::vector<float>{1, 2, 3, 4}, 2, 5).empty());
  EXPECT_TRUE(contour_lines(std::vector<float>{1, 2, 3, 4}, 2, 0).empty());
  EXPECT_TRUE(contour_lines(std::vector<float>{1, 1, 1, 1}, 2, 1).empty());
}

TEST(ContourLines, AreEmptyForFewerThanFourSamples) {
  EXPECT_TRUE(contour_lines({}, 0, 0).empty());
  EXPECT_TRUE(contour_lines(std::vector<float>{0, 1, 2}, 3, 0.5f).empty());
  EXPECT_TRUE(contour_lines(std::vector<float>{0, 1, 2}, 1, 0.5f).empty());
}

TEST(ContourLines, CrossEachSideAtTheInterpolatedPosition) {
  // 0 1
  // 0 2
  const auto lines = contour_lines(std::vector<float>{0, 1, 0, 2}, 2, 0.5f);

  ASSERT_EQ(lines.size(), 1U);
  EXPECT_THAT(lines[0], UnorderedElementsAre(GridPlace{0.5, 0}, GridPlace{0.25, 1}));
}

TEST(ContourLines, SlopeHasOneStraightLineFromEdgeToEdge) {
  const auto heights = sampled(9, 5, [](double column, double row) { return column + 2 * row; });

  const auto lines = contour_lines(heights, 9, 5.5f);

  ASSERT_EQ(lines.size(), 1U);
  const ContourLine line = from_the_left(lines[0]);
  EXPECT_EQ(line.front(), (GridPlace{0, 2.75}));
  EXPECT_EQ(line.back(), (GridPlace{5.5, 0}));
  for (const auto& [column, row] : line) EXPECT_NEAR(column + 2 * row, 5.5, 1e-12);
}

TEST(ContourLines, AroundASummitAreClosed) {
  const auto heights =
      sampled(41, 41, [](double column, double row) { return -std::hypot(column - 20, row - 20); });

  const auto lines = contour_lines(heights, 41, -12.5f);

  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(is_closed(lines[0]));
  EXPECT_NEAR(length_of(lines[0]), 2 * std::numbers::pi * 12.5, 0.1);
  for (const auto& [column, row] : lines[0])
    EXPECT_NEAR(std::hypot(column - 20, row - 20), 12.5, 0.02);
}

TEST(ContourLines, PassASaddleOnTheSameSideAsTheSurface) {
  // Bilinear between these four, the saddle is at height 1.
  const std::vector<float> heights = {2, 0, 0, 2};

  const auto below = contour_lines(heights, 2, 0.5f);
  const auto above = contour_lines(heights, 2, 1.5f);

  ASSERT_EQ(below.size(), 2U);  // around the low corners
  EXPECT_THAT(below[0], UnorderedElementsAre(GridPlace{0.75, 0}, GridPlace{1, 0.25}));
  EXPECT_THAT(below[1], UnorderedElementsAre(GridPlace{0, 0.75}, GridPlace{0.25, 1}));
  ASSERT_EQ(above.size(), 2U);  // around the high corners
  EXPECT_THAT(above[0], UnorderedElementsAre(GridPlace{0.25, 0}, GridPlace{0, 0.25}));
  EXPECT_THAT(above[1], UnorderedElementsAre(GridPlace{1, 0.75}, GridPlace{0.75, 1}));
}

TEST(ContourLines, EndAtUnknownHeights) {
  auto heights = sampled(9, 3, [](double, double row) { return row; });
  heights[4] = nan;

  const auto lines = contour_lines(heights, 9, 0.5f);

  ASSERT_EQ(lines.size(), 2U);
  EXPECT_DOUBLE_EQ(length_of(lines[0]), 3);
  EXPECT_DOUBLE_EQ(length_of(lines[1]), 3);
}

TEST(ContourLines, EndAtInfiniteHeights) {
  auto heights = sampled(3, 2, [](double, double row) { return row; });
  heights[0] = -std::numeric_limits<float>::infinity();

  const auto lines = contour_lines(heights, 3, 0.5f);

  ASSERT_EQ(lines.size(), 1U);
  EXPECT_THAT(lines[0], UnorderedElementsAre(GridPlace{1, 0.5}, GridPlace{2, 0.5}));
}

/// Counts the sides that contour lines must cross: both ends known, one above and one below the
/// level, and next to a known square. A closed line crosses each side once.
std::size_t passed_sides(const std::vector<float>& heights, std::size_t width, float level) {
  const std::size_t rows = heights.size() / width;
  const auto known = [&](std::size_t column, std::size_t row) {
    // Unsigned wrap-around: a sample before the first is beyond the last.
    if (column >= width - 1 || row >= rows - 1) return false;
    const std::size_t i = row * width + column;
    return std::isfinite(heights[i] + heights[i + 1] + heights[i + width] + heights[i + width + 1]);
  };
  std::size_t count = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t i = row * width + column;
      const bool above = heights[i] >= level;
      const bool here = known(column, row);
      if (column + 1 < width && (here || known(column, row - 1)))
        count += static_cast<std::size_t>(above != (heights[i + 1] >= level));
      if (row + 1 < rows && (here || known(column - 1, row)))
        count += static_cast<std::size_t>(above != (heights[i + width] >= level));
    }
  }
  return count;
}

RC_GTEST_PROP(ContourLines, CrossEachSideAtMostOnce, ()) {
  const auto width = *rc::gen::inRange<std::size_t>(2, 12);
  const auto rows = *rc::gen::inRange<std::size_t>(2, 12);
  const auto heights = *rc::gen::container<std::vector<float>>(
      width * rows, rc::gen::weightedElement<float>({{6, 0}, {6, 1}, {6, 2}, {6, 3}, {2, nan}}));
  const auto level = *rc::gen::element(0.5f, 1.7f, 2.2f);

  const auto lines = contour_lines(heights, width, level);

  std::size_t places = 0;
  for (const ContourLine& line : lines) {
    RC_ASSERT(line.size() >= 2U);
    places += line.size() - (line.size() > 2 && is_closed(line) ? 1 : 0);
    for (std::size_t i = 1; i < line.size(); ++i) {
      RC_ASSERT(std::abs(line[i].column - line[i - 1].column) <= 1);
      RC_ASSERT(std::abs(line[i].row - line[i - 1].row) <= 1);
    }
  }
  RC_ASSERT(places == passed_sides(heights, width, level));
}

RC_GTEST_PROP(ContourLines, EndOnlyAtTheEdgeIfAllHeightsAreKnown, ()) {
  const auto width = *rc::gen::inRange<std::size_t>(2, 12);
  const auto rows = *rc::gen::inRange<std::size_t>(2, 12);
  const auto heights = *rc::gen::container<std::vector<float>>(
      width * rows, rc::gen::element(0.0f, 1.0f, 2.0f, 3.0f));

  for (const ContourLine& line : contour_lines(heights, width, *rc::gen::element(1.0f, 1.5f))) {
    if (is_closed(line)) continue;
    for (const auto& [column, row] : {line.front(), line.back()}) {
      RC_ASSERT(column == 0 || row == 0 || column == static_cast<double>(width - 1) ||
                row == static_cast<double>(rows - 1));
    }
  }
}

}  // namespace
}  // namespace flagstone::render
