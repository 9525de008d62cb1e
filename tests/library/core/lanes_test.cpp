// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
//
// Vector functions of each instruction set, compared with plain code.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "forced_target.hpp"
#include "library/core/lane_functions.hpp"
#include "library/core/simd_target.hpp"

namespace flagstone {
namespace {

using tests::FloatLanes;
using tests::Lanes;

std::int32_t pair_of(std::int32_t low, std::int32_t high) {
  return std::bit_cast<std::int32_t>((static_cast<std::uint32_t>(low) & 0xFFFFU) |
                                     static_cast<std::uint32_t>(high) << 16U);
}
std::int32_t low_of(std::int32_t pair) { return static_cast<std::int16_t>(pair & 0xFFFF); }
std::int32_t high_of(std::int32_t pair) { return pair >> 16; }

/// The parameter is the instruction set.
class LanesOn : public testing::TestWithParam<std::string> {
 protected:
  /// Numbers of 32 random bits.
  Lanes any_lanes() {
    Lanes lanes{};
    for (std::int32_t& lane : lanes) lane = static_cast<std::int32_t>(random_());
    return lanes;
  }

  /// Indices from 0 to `end` - 1.
  Lanes any_indices(std::size_t end) {
    Lanes lanes{};
    for (std::int32_t& lane : lanes) lane = static_cast<std::int32_t>(random_() % end);
    return lanes;
  }

  std::mt19937 random_{1};

 private:
  tests::ForcedTarget forced_{GetParam()};
};

INSTANTIATE_TEST_SUITE_P(Target, LanesOn, testing::ValuesIn(simd_targets()),
                         [](const auto& target) { return target.param; });

TEST_P(LanesOn, ASumOfProductsUsesBothHalvesOfALaneWithTheirSigns) {
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const Lanes pairs = any_lanes();
    const Lanes factors = any_lanes();

    const Lanes sums = tests::sum_of_products(pairs, factors);

    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::int64_t sum = std::int64_t{low_of(pairs[i])} * low_of(factors[i]) +
                               std::int64_t{high_of(pairs[i])} * high_of(factors[i]);
      ASSERT_EQ(sums[i], static_cast<std::int32_t>(sum)) << pairs[i] << ", " << factors[i];
    }
  }
  Lanes largest{};
  largest.fill(pair_of(-32768, 32767));
  for (const std::int32_t sum : tests::sum_of_products(largest, largest)) {
    EXPECT_EQ(sum, 32768 * 32768 + 32767 * 32767);
  }
}

TEST_P(LanesOn, SaturatedPairsAreTheNearestIntegersOf16Bits) {
  constexpr std::array<std::int32_t, 10> numbers = {0,      1,      -1,        32767,      32768,
                                                    -32768, -32769, 1'000'000, -1'000'000, 12345};
  const auto saturated = [](std::int32_t v) { return std::clamp(v, -32768, 32767); };
  for (int repeat = 0; repeat < 1000; ++repeat) {
    Lanes first = any_lanes();
    Lanes second = any_lanes();
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (repeat % 2 == 0) continue;
      first[i] = numbers.at(random_() % numbers.size());
      second[i] = numbers.at(random_() % numbers.size());
    }

    const Lanes pairs = tests::saturated_pairs(first, second);

    for (std::size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_EQ(pairs[i], pair_of(saturated(first[i]), saturated(second[i])))
          << first[i] << ", " << second[i];
    }
  }
}

TEST_P(LanesOn, ARankIsTheNumberOfSetBitsUpToALane) {
  const std::size_t length = tests::vector_length();
  for (std::uint32_t bits = 1; bits < 1U << length; bits += 2) {
    const Lanes ranks = tests::ranks_of(bits);
    for (std::size_t lane = 0; lane < length; ++lane) {
      const std::uint32_t up_to = bits & ((2U << lane) - 1);
      ASSERT_EQ(ranks[lane], std::popcount(up_to) - 1) << bits << ", lane " << lane;
    }
  }
}

TEST_P(LanesOn, BitsOfAMaskBeginWithTheLowestLane) {
  const std::size_t length = tests::vector_length();
  for (std::uint32_t bits = 0; bits < 1U << length; ++bits) {
    Lanes lanes{};
    for (std::size_t lane = 0; lane < length; ++lane) {
      lanes[lane] = static_cast<std::int32_t>(bits >> lane & 1U);
    }
    ASSERT_EQ(tests::bits_of(lanes), bits);
  }
}

TEST_P(LanesOn, StoredBitsAreBytesOf0Or1) {
  const std::size_t length = tests::vector_length();
  for (std::uint32_t bits = 0; bits < 1U << length; ++bits) {
    std::vector<std::uint8_t> expected;
    for (std::size_t lane = 0; lane < length; ++lane) {
      expected.push_back(static_cast<std::uint8_t>(bits >> lane & 1U));
    }
    ASSERT_EQ(tests::stored_bits(bits), expected);
  }
}

TEST_P(LanesOn, ATableOfOneVectorCanBeLookedUp) {
  const std::size_t end = tests::vector_length();
  std::array<float, 33> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = 100 + static_cast<float>(i);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Lanes indices = any_indices(end);

    const FloatLanes found = tests::lookup_in_one(table.data() + 1, indices);  // not aligned

    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i], 101 + static_cast<float>(indices[i]));
    }
  }
}

TEST_P(LanesOn, ATableOfEightNumbersCanBeLookedUp) {
  std::array<float, 9> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = 100 + static_cast<float>(i);
  for (int repeat = 0; repeat < 100; ++repeat) {
    const Lanes indices = any_indices(8);

    const FloatLanes found = tests::lookup_in_eight(table.data() + 1, indices);  // not aligned

    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ(found[i], 101 + static_cast<float>(indices[i]));
    }
  }
}

}  // namespace
}  // namespace flagstone
