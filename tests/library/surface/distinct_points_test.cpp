// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/distinct_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone::surface {
namespace {

/// The distinct points, in the order of copy_distinct().
std::vector<PackedPoint> distinct(std::vector<PackedPoint> points) {
  const std::size_t count = points.size();
  std::vector<PackedPoint> scratch(count + 1);
  points.resize(count + 16);  // that can be read
  scratch.resize(copy_distinct(std::span(points.data(), count), scratch.data(), scratch.data()));
  return scratch;
}

/// `count` points with up to `values` different ones.
std::vector<PackedPoint> random_points(std::size_t count, std::uint32_t values,
                                       std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<PackedPoint> of_values(values);
  for (PackedPoint& value : of_values) value = static_cast<PackedPoint>(random());
  std::vector<PackedPoint> points(count);
  for (PackedPoint& point : points) point = of_values[random() % values];
  return points;
}

/// The parameter is the instruction set.
class DistinctPointsOn : public testing::TestWithParam<std::string> {
 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, DistinctPointsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(DistinctPointsOn, OccurOnceEach) {
  for (const std::size_t count : {1U, 2U, 15U, 16U, 17U, 100U, 255U, 256U, 257U, 5000U}) {
    for (const std::uint32_t values : {1U, 2U, 40U, 100'000U}) {
      const std::vector<PackedPoint> points = random_points(count, values, 3);
      const std::set<PackedPoint> expected(points.begin(), points.end());

      EXPECT_THAT(distinct(points), testing::UnorderedElementsAreArray(expected)) << count;
    }
  }
}

TEST_P(DistinctPointsOn, AreTheSameForAnyOrder) {
  for (const std::size_t count : {50U, 1000U}) {
    std::vector<PackedPoint> points = random_points(count, 30, 4);
    const std::vector<PackedPoint> expected = distinct(points);
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      std::ranges::shuffle(points, std::mt19937(seed));

      EXPECT_THAT(distinct(points), testing::UnorderedElementsAreArray(expected));
    }
  }
}

TEST_P(DistinctPointsOn, CanDifferInOneByte) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    std::vector<PackedPoint> points;
    for (PackedPoint value = 0; value < 1000; ++value) points.push_back((value & 0xFFU) << shift);

    EXPECT_EQ(distinct(points).size(), 256U) << shift;
  }
}

TEST_P(DistinctPointsOn, CanBeCopiedToTheFrontOfTheScratchMemory) {
  for (const std::size_t count : {20U, 700U}) {
    std::vector<PackedPoint> points = random_points(count, 10, 5);
    const std::vector<PackedPoint> expected = distinct(points);
    points.resize(count + 16);
    std::vector<PackedPoint> memory(count + 3, 7);

    const std::size_t found =
        copy_distinct(std::span(points.data(), count), memory.data() + 3, memory.data() + 1);

    EXPECT_THAT(std::span(memory.data() + 1, found), testing::UnorderedElementsAreArray(expected));
    EXPECT_EQ(memory.front(), 7U);
  }
}

}  // namespace
}  // namespace flagstone::surface
