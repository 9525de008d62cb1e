// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "lab/bench/benchmark.hpp"

namespace flagstone::bench {
namespace {

using testing::ElementsAre;

TEST(Rotation, EachCandidateBeginsOnceForwardsAndOnceBackwards) {
  EXPECT_THAT(order_of_round(3, 0), ElementsAre(0, 1, 2));
  EXPECT_THAT(order_of_round(3, 1), ElementsAre(0, 2, 1));
  EXPECT_THAT(order_of_round(3, 2), ElementsAre(1, 2, 0));
  EXPECT_THAT(order_of_round(3, 3), ElementsAre(1, 0, 2));
  EXPECT_THAT(order_of_round(3, 4), ElementsAre(2, 0, 1));
  EXPECT_THAT(order_of_round(3, 5), ElementsAre(2, 1, 0));
  EXPECT_EQ(order_of_round(3, 6), order_of_round(3, 0));
}

TEST(Rotation, EveryCandidateRunsOnceInEveryRound) {
  for (std::size_t candidates = 1; candidates < 9; ++candidates) {
    for (std::size_t round = 0; round < 20; ++round) {
      const auto order = order_of_round(candidates, round);
      const std::set<std::size_t> distinct(order.begin(), order.end());
      EXPECT_EQ(order.size(), candidates);
      EXPECT_EQ(distinct.size(), candidates);
      EXPECT_LT(*distinct.rbegin(), candidates);
    }
  }
}

TEST(Rotation, NoCandidateAlwaysFollowsTheSameOne) {
  std::set<std::pair<std::size_t, std::size_t>> neighbours;
  for (std::size_t round = 0; round < 8; ++round) {
    const auto order = order_of_round(4, round);
    for (std::size_t i = 1; i < order.size(); ++i) neighbours.emplace(order[i - 1], order[i]);
  }

  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_TRUE(neighbours.contains({i, (i + 1) % 4}));
    EXPECT_TRUE(neighbours.contains({(i + 1) % 4, i}));
  }
}

}  // namespace
}  // namespace flagstone::bench
