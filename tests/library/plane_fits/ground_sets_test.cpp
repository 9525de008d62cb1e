// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/ground_sets.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/plane_fits/batch_of.hpp"
#include "numbers.hpp"

namespace flagstone::plane_fits {
namespace {

/// Sums over a set, and sums of the absolute values of the terms.
struct NaiveSums {
  Moments moments;
  Vector3 absolute{};
  double all_squares = 0;
};

/// The sums over the set of bin `i`, computed point by point.
NaiveSums naive(const BinBatch& batch, std::size_t i, const GroundSet& set) {
  NaiveSums sums;
  for (std::size_t k = 0; k < batch.size(i); ++k) {
    const float x = batch.x(i)[k];
    const float y = batch.y(i)[k];
    const float z = batch.z(i)[k];
    const float height = (set.normal_x * x + set.normal_y * y) + set.normal_z * z;
    if (height < set.bottom || height >= set.top) continue;
    const Vector3 p = {x, y, z};
    sums.moments.add(p[0], p[1], p[2]);
    for (std::size_t c = 0; c < 3; ++c) {
      sums.absolute.at(c) += std::abs(p.at(c));
      sums.all_squares += p.at(c) * p.at(c);
    }
  }
  return sums;
}

std::vector<std::vector<float>> any_bins(std::size_t count, std::size_t most_points,
                                         std::mt19937& random) {
  std::vector<std::vector<float>> bins(count);
  for (std::vector<float>& heights : bins) {
    heights.resize(random() % most_points + 1);
    for (float& z : heights) z = -2 + 3 * static_cast<float>(random() >> 8U) / 16777216.0f;
  }
  return bins;
}

GroundSets any_sets(std::mt19937& random) {
  const auto any = [&] { return static_cast<float>(random() >> 8U) / 16777216.0f; };
  GroundSets sets{};
  for (GroundSet& set : sets) {
    set = {.normal_x = 0.3f * (any() - 0.5f),
           .normal_y = 0.3f * (any() - 0.5f),
           .normal_z = 0.95f,
           .bottom = random() % 3 == 0 ? -inf : -2 + any(),
           .top = -1 + 2 * any()};
  }
  return sets;
}

constexpr BinMask all_bins = 0xFFFF;

/// The parameter is the instruction set.
class SumMomentsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, SumMomentsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

/// Asserts that sums match the sums point by point, relative to the sums of absolute values.
void check_sums(Precision precision, double share, std::size_t most_points) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  const auto count = *rc::gen::inRange<std::size_t>(1, batch_size + 1);
  const BinBatch batch = tests::batch_of(any_bins(count, most_points, random));
  const GroundSets sets = any_sets(random);

  MomentsBatch moments{};
  sum_moments(batch, sets, all_bins, precision, moments);

  for (std::size_t i = 0; i < count; ++i) {
    const NaiveSums expected = naive(batch, i, sets.at(i));
    RC_ASSERT(moments.count[i] == expected.moments.count);
    for (std::size_t k = 0; k < 3; ++k) {
      const double error = std::abs(moments.sum.at(k)[i] - expected.moments.sum.at(k));
      RC_ASSERT(error <= share * expected.absolute.at(k));
    }
    for (std::size_t k = 0; k < 6; ++k) {
      const double error = std::abs(moments.squares.at(k)[i] - expected.moments.squares.at(k));
      RC_ASSERT(error <= share * expected.all_squares);
    }
  }
}

TEST_P(SumMomentsOn, AreWithin4e6OfNaiveSumsInSinglePrecision) {
  EXPECT_TRUE(rc::check([] { check_sums(Precision::single, 4e-6, 300); }));
}

TEST_P(SumMomentsOn, AreWithin1e12OfNaiveSumsInFullPrecision) {
  EXPECT_TRUE(rc::check([] { check_sums(Precision::full, 1e-12, 300); }));
}

TEST_P(SumMomentsOn, KeepTheirPrecisionOverManyPoints) {
  std::mt19937 random(1);
  const BinBatch batch = tests::batch_of({std::vector<float>(300'000, -0.3f)});
  GroundSets sets{};
  sets[0] = {0, 0, 1, -inf, 1};
  const NaiveSums expected = naive(batch, 0, sets[0]);

  MomentsBatch single{};
  MomentsBatch full{};
  sum_moments(batch, sets, 1, Precision::single, single);
  sum_moments(batch, sets, 1, Precision::full, full);

  EXPECT_EQ(single.count[0], 300'000);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(single.squares.at(k)[0], expected.moments.squares.at(k),
                4e-6 * expected.all_squares);
    EXPECT_NEAR(full.squares.at(k)[0], expected.moments.squares.at(k),
                1e-12 * expected.all_squares);
  }
}

TEST_P(SumMomentsOn, DoNotChangeOtherBins) {
  const BinBatch batch = tests::batch_of({{-1, -1, -1}, {-1, -1}, {-1, -1, -1, -1}});
  GroundSets sets{};
  sets.fill({0, 0, 1, -inf, inf});
  MomentsBatch moments{};
  moments.count.fill(77);
  moments.squares[5].fill(77);

  sum_moments(batch, sets, 0b101, Precision::single, moments);

  EXPECT_EQ(moments.count[0], 3);
  EXPECT_EQ(moments.count[1], 77);
  EXPECT_EQ(moments.squares[5][1], 77);
  EXPECT_EQ(moments.count[2], 4);
  EXPECT_EQ(moments.count[3], 77);
}

TEST_P(SumMomentsOn, IncludePointsOnTheBottomButNotOnTheTop) {
  const BinBatch batch = tests::batch_of({{-1, 0, 1, 2}});
  GroundSets sets{};
  sets[0] = {0, 0, 1, -1, 1};
  for (const Precision precision : {Precision::single, Precision::full, Precision::exact}) {
    MomentsBatch moments{};

    sum_moments(batch, sets, 1, precision, moments);

    EXPECT_EQ(moments.count[0], 2);
    EXPECT_EQ(moments.sum[2][0], -1);
  }
}

TEST_P(SumMomentsOn, AreZeroForASetWithoutPointsOrBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const BinBatch batch = tests::batch_of({{-1, 0, 1}, {-1, 0, 1}});
  GroundSets sets{};
  sets[0] = {0, 0, 1, 5, 6};
  sets[1] = {nan, nan, nan, nan, nan};  // the set of a plane without points
  for (const Precision precision : {Precision::single, Precision::full, Precision::exact}) {
    MomentsBatch moments{};
    moments.count.fill(77);

    sum_moments(batch, sets, 0b11, precision, moments);

    for (const std::size_t i : {0U, 1U}) {
      EXPECT_EQ(moments.count[i], 0);
      EXPECT_EQ(moments.sum[0][i], 0);
      EXPECT_EQ(moments.squares[0][i], 0);
    }
  }
}

TEST_P(SumMomentsOn, OfFirstSetsMatchTheShiftedHeights) {
  BinBatch batch = tests::batch_of({{-1.5f, -1.25f, -1, 3}});

  MomentsBatch first{};
  sum_first_moments(batch, {{{.origin = -1.5f, .bottom = 0, .top = 1}}}, Precision::single, first);
  GroundSets sets{};
  sets[0] = {0, 0, 1, 0, 1};  // relative to -1.5 m
  MomentsBatch again{};
  sum_moments(batch, sets, 1, Precision::single, again);

  EXPECT_EQ(batch.z(0)[0], 0);
  EXPECT_EQ(batch.z(0)[3], 4.5f);
  for (const MomentsBatch& moments : {first, again}) {
    EXPECT_EQ(moments.count[0], 3);
    EXPECT_EQ(moments.sum[2][0], 0.0 + 0.25 + 0.5);
  }
}

/// A point on the grid of ExactGrid.
struct GridPoint {
  float x, y, z;
};

/// Random points on the grid of ExactGrid, up to its reach.
std::vector<GridPoint> any_grid_points(std::size_t count, std::mt19937& random) {
  const auto any = [&](float step) {
    const auto most = static_cast<int>(ExactGrid::reach / step);
    return static_cast<float>(static_cast<int>(random() % (2U * static_cast<unsigned>(most) + 1)) -
                              most) *
           step;
  };
  std::vector<GridPoint> points(count);
  for (GridPoint& p : points) {
    p = {any(ExactGrid::xy_step), any(ExactGrid::xy_step), any(ExactGrid::z_step)};
  }
  return points;
}

/// A batch of one bin.
BinBatch batch_of_one(const std::vector<GridPoint>& points) {
  BinBatch batch;
  batch.reserve(points.size());
  batch.clear();
  batch.add_empty(points.size(), {.x = 0, .y = 0});
  for (std::size_t k = 0; k < batch.places(0); ++k) {
    const GridPoint p = k < points.size() ? points[k] : GridPoint{0, 0, inf};
    batch.x(0)[k] = p.x;
    batch.y(0)[k] = p.y;
    batch.z(0)[k] = p.z;
  }
  return batch;
}

/// Asserts that the moments of bin 0 are the exact ones. Sums in double precision are exact here.
void expect_exact(const MomentsBatch& moments, const Moments& exact) {
  EXPECT_EQ(moments.count[0], exact.count);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(moments.sum.at(k)[0], exact.sum.at(k)) << k;
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(moments.squares.at(k)[0], exact.squares.at(k)) << k;
}

TEST_P(SumMomentsOn, AreExactOnTheGridInAnyOrder) {
  std::mt19937 random(5);
  for (const std::size_t size : {1U, 3U, 15U, 16U, 17U, 100U, 127U, 128U}) {
    std::vector<GridPoint> points = any_grid_points(size, random);
    const GroundSets sets = any_sets(random);
    const Moments exact = naive(batch_of_one(points), 0, sets[0]).moments;
    for (int repeat = 0; repeat < 5; ++repeat) {
      std::ranges::shuffle(points, random);
      MomentsBatch moments{};

      sum_moments(batch_of_one(points), sets, 1, Precision::exact, moments);

      expect_exact(moments, exact);
    }
  }
}

TEST_P(SumMomentsOn, AreExactAtTheCornerOfTheGrid) {
  const float reach = ExactGrid::reach;
  const std::vector<GridPoint> points(ExactGrid::most_points, {reach, -reach, reach});
  GroundSets sets{};
  sets[0] = {0, 0, 1, -inf, inf};
  MomentsBatch moments{};

  sum_moments(batch_of_one(points), sets, 1, Precision::exact, moments);

  expect_exact(moments, naive(batch_of_one(points), 0, sets[0]).moments);
}

TEST_P(SumMomentsOn, OfFirstSetsAreExactOnTheGridInAnyOrder) {
  std::mt19937 random(6);
  const FirstSet first_set{.origin = -1.5f, .bottom = -0.75f, .top = 1.25f};
  const GroundSet set{0, 0, 1, first_set.bottom, first_set.top};
  std::vector<GridPoint> points = any_grid_points(ExactGrid::most_points, random);
  std::vector<GridPoint> shifted = points;
  for (GridPoint& p : shifted) p.z -= first_set.origin;
  const Moments exact = naive(batch_of_one(shifted), 0, set).moments;
  for (int repeat = 0; repeat < 5; ++repeat) {
    std::ranges::shuffle(points, random);
    BinBatch batch = batch_of_one(points);
    MomentsBatch moments{};

    sum_first_moments(batch, {{first_set}}, Precision::exact, moments);

    expect_exact(moments, exact);
  }
}

TEST_P(SumMomentsOn, OfExactFirstSetsRaisePointsBeyondTheReachToInfinity) {
  const float reach = ExactGrid::reach;
  const float step = ExactGrid::z_step;
  const std::vector<float> heights = {-reach - step, -reach, 0, reach, reach + step, inf};
  std::vector<GridPoint> points;
  for (const float z : heights) points.push_back({1, 2, z - 1.5f});
  BinBatch batch = batch_of_one(points);
  MomentsBatch moments{};

  sum_first_moments(batch, {{{.origin = -1.5f, .bottom = -inf, .top = inf}}}, Precision::exact,
                    moments);

  EXPECT_EQ(moments.count[0], 3);
  EXPECT_EQ(moments.sum[2][0], 0);
  const std::vector<float> expected = {inf, -reach, 0, reach, inf, inf};
  for (std::size_t k = 0; k < heights.size(); ++k) EXPECT_EQ(batch.z(0)[k], expected[k]) << k;
}

}  // namespace
}  // namespace flagstone::plane_fits
