// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Samples that depend on the set of points, but not on their order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "forced_target.hpp"
#include "library/core/simd_target.hpp"
#include "library/surface/vector_functions.hpp"

namespace flagstone::surface {
namespace {

using Points = std::vector<PackedPoint>;

constexpr tests::SizeOfSample size_of_cell{.most = 32, .wanted = 24};
constexpr tests::SizeOfSample size_of_patch{.most = 128, .wanted = 112};

Points any_points(std::size_t count, std::mt19937& random) {
  Points points(count);
  std::ranges::generate(points, random);
  return points;
}

Points sorted(Points points) {
  std::ranges::sort(points);
  return points;
}

/// A way to take a sample, and its sizes.
struct Sampling {
  Points (*take)(Points points, tests::SizeOfSample size);
  tests::SizeOfSample size;
};

/// The parameters are the instruction set and whether a cell or a patch is sampled.
class ContentSample : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  [[nodiscard]] static Sampling sampling() {
    return std::get<1>(GetParam()) ? Sampling{tests::patch_sample_of, size_of_patch}
                                   : Sampling{tests::sample_of, size_of_cell};
  }
  [[nodiscard]] static Points sample_of(const Points& points) {
    return sampling().take(points, sampling().size);
  }

  std::mt19937 random_{1};

 private:
  tests::ForcedTarget forced_{std::get<0>(GetParam())};
};

INSTANTIATE_TEST_SUITE_P(Target, ContentSample,
                         testing::Combine(testing::ValuesIn(simd_targets()), testing::Bool()),
                         [](const auto& target) {
                           return std::get<0>(target.param) +
                                  (std::get<1>(target.param) ? "Patch" : "Cell");
                         });

TEST_P(ContentSample, HasAtMostTheMaximumNumberOfPoints) {
  const auto [most, wanted] = sampling().size;
  double sampled = 0;
  for (std::size_t count = most + 1; count < 20 * most; count += 7) {
    const Points sample = sample_of(any_points(count, random_));
    EXPECT_LE(sample.size(), most) << count;
    sampled += static_cast<double>(sample.size()) / static_cast<double>((20 * most - most - 1) / 7);
  }
  // On average; less than `wanted`, because the threshold is reduced in a part of the cases.
  EXPECT_NEAR(sampled, wanted, 0.15 * wanted);
}

TEST_P(ContentSample, ContainsPointsOfTheSetInTheirOrder) {
  const Points points = any_points(500, random_);

  const Points sample = sample_of(points);

  auto from = points.begin();
  for (const PackedPoint point : sample) {
    from = std::find(from, points.end(), point);
    ASSERT_NE(from, points.end());
    ++from;
  }
}

TEST_P(ContentSample, DoesNotDependOnTheOrderOfThePoints) {
  for (const std::size_t count : {33U, 64U, 100U, 129U, 200U, 500U, 5000U}) {
    Points points = any_points(count, random_);
    const Points expected = sorted(sample_of(points));
    for (int repeat = 0; repeat < 10; ++repeat) {
      std::ranges::shuffle(points, random_);
      EXPECT_EQ(sorted(sample_of(points)), expected) << count;
    }
  }
}

TEST_P(ContentSample, TakesEqualPointsTogether) {
  Points points = any_points(200, random_);
  for (std::size_t i = 0; i < 200; ++i) points.insert(points.end(), i % 3, points[i]);
  std::ranges::shuffle(points, random_);

  const Points sample = sample_of(points);

  EXPECT_FALSE(sample.empty());
  for (const PackedPoint point : sample) {
    EXPECT_EQ(std::ranges::count(sample, point), std::ranges::count(points, point));
  }
}

TEST_P(ContentSample, IsEmptyIfTooManyPointsAreEqual) {
  EXPECT_TRUE(sample_of(Points(500, 0x12345678)).empty());
}

TEST_P(ContentSample, IsTheSameOnEveryInstructionSet) {
  for (const std::size_t count : {33U, 200U, 1000U, 70000U}) {
    const Points points = any_points(count, random_);
    const Points sample = sample_of(points);
    for (const std::string& target : simd_targets()) {
      const tests::ForcedTarget other(target);
      EXPECT_EQ(sample_of(points), sample) << target << ", " << count;
    }
    use_simd_target(std::get<0>(GetParam()));
  }
}

TEST_P(ContentSample, CoversAllPositionsAndHeights) {
  // Points of a wall and of ground, at the positions of a lattice.
  Points points;
  for (std::uint32_t i = 0; i < 1024; ++i) points.push_back(i % 32 * 8 | (i / 32 * 8) << 8);
  for (std::uint32_t i = 0; i < 1024; ++i) points.push_back(i % 32 * 8 | 3 << 8 | (i / 32) << 20);
  std::size_t near = 0;  // in x
  std::size_t ground = 0;
  std::size_t all = 0;
  for (std::uint32_t shift = 0; shift < 8; ++shift) {
    Points moved = points;
    for (PackedPoint& point : moved) point += shift * 0x00010101;
    for (const PackedPoint point : sample_of(moved)) {
      near += (point & 0xFFU) < 128 ? 1U : 0U;
      ground += (point >> 16U) == shift ? 1U : 0U;
      ++all;
    }
  }
  EXPECT_NEAR(static_cast<double>(near), 0.5 * static_cast<double>(all),
              0.2 * static_cast<double>(all));
  EXPECT_NEAR(static_cast<double>(ground), 0.5 * static_cast<double>(all),
              0.2 * static_cast<double>(all));
}

}  // namespace
}  // namespace flagstone::surface
