// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/random.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace flagstone {
namespace {

TEST(Random, IsSplitMix64) {
  Random random(1234567);

  // Reference output of the generator for this seed.
  EXPECT_EQ(random.bits(), 6457827717110365317U);
  EXPECT_EQ(random.bits(), 3203168211198807973U);
}

TEST(Random, StreamsOfNeighbouringIndicesDiffer) {
  EXPECT_NE(Random::stream(1, 0).bits(), Random::stream(1, 1).bits());
  EXPECT_NE(Random::stream(1, 0).bits(), Random::stream(2, 0).bits());
}

TEST(Random, NormalHasMeanZeroAndDeviationOne) {
  constexpr int draws = 100'000;
  double sum = 0;
  double squares = 0;
  for (std::uint64_t i = 0; i < draws; ++i) {
    const double value = Random::stream(7, i).normal();
    sum += value;
    squares += value * value;
  }

  EXPECT_NEAR(sum / draws, 0, 0.02);
  EXPECT_NEAR(squares / draws, 1, 0.02);
}

TEST(Random, UniformStaysWithinItsBounds) {
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.uniform(-2, 5);
    ASSERT_GE(value, -2);
    ASSERT_LT(value, 5);
  }
}

}  // namespace
}  // namespace flagstone
