// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "files/render/height_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_surface.hpp"

namespace flagstone::render {
namespace {

using tests::random_surface;

float slanted(float x, float y) { return -1.7f + 0.1f * x - 0.2f * y; }

TEST(HeightMap, StartsAtTheSmallestXAndTheLargestY) {
  const HeightMap map = map_of(random_surface(slanted), 32, 0.5);

  ASSERT_EQ(map.width, 128U);
  ASSERT_EQ(map.heights.size(), 128U * 128U);
  EXPECT_EQ(map.x(0), -31.75);
  EXPECT_EQ(map.y(0), 31.75);
  EXPECT_EQ(map.x(127), 31.75);
  EXPECT_EQ(map.y(127), -31.75);
}

TEST(HeightMap, ContainsTheHeightOfTheSurfaceAtEachCellCentre) {
  const GroundSurface surface = random_surface(slanted);

  const HeightMap map = map_of(surface, 32, 0.5);

  for (const std::size_t row : {0U, 40U, 63U, 127U}) {
    for (const std::size_t column : {0U, 64U, 100U, 127U}) {
      const auto x = static_cast<float>(map.x(static_cast<double>(column)));
      const auto y = static_cast<float>(map.y(static_cast<double>(row)));
      EXPECT_EQ(map.heights[row * map.width + column], surface.height(x, y));
    }
  }
}

TEST(HeightMap, CoversAnExtentThatIsNotAWholeNumberOfCells) {
  const HeightMap map = map_of(random_surface(slanted), 32, 5);

  EXPECT_EQ(map.width, 14U);
  EXPECT_EQ(map.extent(), 35);
  EXPECT_TRUE(std::isnan(map.heights.front()));  // at (-32.5, 32.5), outside of the surface
  EXPECT_FALSE(std::isnan(map.heights[14 + 1]));
}

TEST(HeightMap, DoesNotAddACellBecauseOfRounding) {
  EXPECT_EQ(map_of(random_surface(slanted), 32, 0.1).width, 640U);
}

TEST(SmoothedHeightMap, IsUnchangedOnAPlane) {
  const GroundSurface surface = random_surface(slanted, std::vector<tests::GridSize>{{1, 64}});

  const HeightMap map = map_of(surface, 30, 0.5);
  const HeightMap smoothed = smoothed_map_of(surface, 30, 0.5);

  for (std::size_t i = 0; i < map.heights.size(); ++i)
    ASSERT_NEAR(smoothed.heights[i], map.heights[i], 1e-5);
}

TEST(SmoothedHeightMap, RoundsABendBetweenCells) {
  const GroundSurface ridge = random_surface([](float x, float) { return x == 0.5f ? 1.0f : 0.0f; },
                                             std::vector<tests::GridSize>{{1, 64}});

  const HeightMap smoothed = smoothed_map_of(ridge, 8, 1);

  EXPECT_EQ(smoothed.heights[8], 0.5f);
  EXPECT_EQ(smoothed.heights[9], 0.25f);
  EXPECT_EQ(smoothed.heights[10], 0);
}

}  // namespace
}  // namespace flagstone::render
