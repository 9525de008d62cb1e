// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/plane_fits/seed_heights.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/plane_fits/batch_of.hpp"
#include "numbers.hpp"

namespace flagstone::plane_fits {
namespace {

using Heights = std::vector<float>;

/// A direct implementation of eq. (5).
double naive(Heights heights, float floor, std::size_t seed_count) {
  std::erase_if(heights, [=](float z) { return z < floor; });
  std::ranges::sort(heights);
  heights.resize(std::min(heights.size(), seed_count));
  double sum = 0;
  for (const float z : heights) sum += static_cast<double>(z);
  return heights.empty() ? 0 : sum / static_cast<double>(heights.size());
}

/// The result for these bins, with the same floor for all.
Batch found(const std::vector<Heights>& bins, float floor,
            const std::array<std::uint32_t, batch_size>& seed_counts) {
  std::size_t points = 0;
  for (const Heights& heights : bins) points += heights.size();
  const BinBatch batch = tests::batch_of(bins);
  std::array<float, batch_size> floors{};
  floors.fill(floor);
  SeedHeights seed_heights;
  seed_heights.reserve(points);
  Batch means;
  seed_heights.find(batch, floors, seed_counts, means);
  return means;
}

/// The result for these bins, with the same number of seeds for all.
Batch found(const std::vector<Heights>& bins, float floor, std::size_t seed_count) {
  std::array<std::uint32_t, batch_size> seed_counts{};
  seed_counts.fill(static_cast<std::uint32_t>(seed_count));
  return found(bins, floor, seed_counts);
}

/// Heights from -3 to 1 m with `levels` different values.
Heights any_heights(std::size_t count, unsigned levels, std::mt19937& random) {
  Heights heights(count);
  for (float& z : heights) {
    z = -3 + 4 * static_cast<float>(random() % levels) / static_cast<float>(levels);
  }
  return heights;
}

void expect_naive(const std::vector<Heights>& bins, float floor, std::size_t seed_count) {
  const Batch means = found(bins, floor, seed_count);
  for (std::size_t i = 0; i < bins.size(); ++i) {
    ASSERT_EQ(means[i], naive(bins[i], floor, seed_count))
        << bins[i].size() << " points, floor " << floor << ", " << seed_count << " seeds";
  }
}

const std::vector<std::size_t> seed_counts = {1, 2, 16, 19, 20, 31, 32, 33, 1000};

/// The parameter is the instruction set.
class SeedHeightsOn : public testing::TestWithParam<std::string> {
  tests::ForcedTarget forced{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, SeedHeightsOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(SeedHeightsOn, AreTheMeanOfTheLowestForBinsOf1To200Points) {
  std::mt19937 random(1);
  for (std::size_t first = 1; first <= 200; first += batch_size) {
    std::vector<Heights> bins;
    bins.reserve(batch_size);
    for (std::size_t i = 0; i < batch_size; ++i) {
      bins.push_back(any_heights(first + i, 1U << 20U, random));
    }
    for (const std::size_t seed_count : seed_counts) {
      expect_naive(bins, -inf, seed_count);
      expect_naive(bins, -1.9f, seed_count);
    }
  }
}

TEST_P(SeedHeightsOn, AreTheMeanOfTheLowestForBinsOf5000Points) {
  std::mt19937 random(2);
  std::vector<Heights> bins;
  for (const unsigned levels : {1U, 2U, 7U, 100U, 1U << 20U}) {
    bins.push_back(any_heights(5000, levels, random));
  }
  for (const std::size_t seed_count : seed_counts) {
    expect_naive(bins, -inf, seed_count);
    expect_naive(bins, -1.9f, seed_count);
  }
}

TEST_P(SeedHeightsOn, AreCorrectForSortedHeights) {
  // The lowest points are then at neighbouring positions, or in a few lanes if steps are sixteen.
  Heights rising(1000);
  Heights falling(1000);
  Heights low_in_one_lane(1000);
  for (std::size_t i = 0; i < rising.size(); ++i) {
    rising[i] = -3 + 0.002f * static_cast<float>(i);
    falling[i] = -1 - 0.002f * static_cast<float>(i);
    low_in_one_lane[i] = rising[i] + (i % 16 == 5 ? -2.0f : 0.0f);
  }
  for (const std::size_t seed_count : seed_counts) {
    expect_naive({rising, falling, low_in_one_lane}, -inf, seed_count);
  }
}

TEST_P(SeedHeightsOn, AreCorrectForAnyHeights) {
  EXPECT_TRUE(rc::check([] {
    const auto seed_count = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(1, 40),
                                            rc::gen::inRange<std::size_t>(1, 1001));
    const unsigned levels = 1U << *rc::gen::inRange(0U, 20U);
    const float floor = *rc::gen::element(-inf, -3.0f, -2.5f, -1.0f, 0.99f, 5.0f, inf);
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    std::vector<Heights> bins;
    for (std::size_t i = 0; i < *rc::gen::inRange<std::size_t>(1, batch_size + 1); ++i) {
      bins.push_back(any_heights(*rc::gen::inRange<std::size_t>(1, 300), levels, random));
    }

    const Batch means = found(bins, floor, seed_count);

    for (std::size_t i = 0; i < bins.size(); ++i) {
      RC_ASSERT(means[i] == naive(bins[i], floor, seed_count));
    }
  }));
}

TEST_P(SeedHeightsOn, AreZeroIfAllPointsAreBelowTheFloor) {
  for (const std::size_t seed_count : seed_counts) {
    EXPECT_EQ(found({Heights(100, -1.7f)}, -1, seed_count)[0], 0);
  }
}

TEST_P(SeedHeightsOn, IncludePointsOnTheFloor) {
  for (const std::size_t seed_count : seed_counts) {
    EXPECT_EQ(found({{-1.5f, -1.75f, -3.0f}}, -1.75f, seed_count)[0],
              seed_count == 1 ? -1.75 : (-1.75 - 1.5) / 2);
  }
}

TEST_P(SeedHeightsOn, DoNotDependOnTheOrderOfThePoints) {
  std::mt19937 random(3);
  Heights heights = any_heights(700, 1U << 20U, random);
  for (const std::size_t seed_count : seed_counts) {
    const double mean = found({heights}, -inf, seed_count)[0];
    for (int repeat = 0; repeat < 5; ++repeat) {
      std::ranges::shuffle(heights, random);
      EXPECT_EQ(found({heights}, -inf, seed_count)[0], mean);
    }
  }
}

TEST_P(SeedHeightsOn, CanUseADifferentNumberOfSeedsPerBin) {
  std::mt19937 random(4);
  std::vector<Heights> bins;
  std::array<std::uint32_t, batch_size> counts{};
  for (std::size_t i = 0; i < batch_size; ++i) {
    bins.push_back(any_heights(20 + 30 * i, 1U << 20U, random));
    counts.at(i) = static_cast<std::uint32_t>(seed_counts.at(i % seed_counts.size()));
  }

  const Batch means = found(bins, -2.5f, counts);

  for (std::size_t i = 0; i < bins.size(); ++i) {
    EXPECT_EQ(means[i], naive(bins[i], -2.5f, counts.at(i))) << counts.at(i) << " seeds";
  }
}

}  // namespace
}  // namespace flagstone::plane_fits
