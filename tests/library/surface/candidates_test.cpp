// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/surface/candidates.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace flagstone::surface {
namespace {

/// A grid of 6 x 6 cells.
class Candidates : public testing::Test {
 protected:
  static constexpr std::uint32_t width = 6;

  static std::uint32_t place(std::uint32_t row, std::uint32_t column) {
    return row * width + column;
  }

  void set(std::uint32_t row, std::uint32_t column, float correction) {
    values_[place(row, column)] = correction;
    weights_[place(row, column)] = 1;
  }

  void add(std::uint32_t row, std::uint32_t column, float correction, float weight = 0.5f) {
    candidates_.push_back(
        {.place = place(row, column), .correction = correction, .weight = weight});
  }

  [[nodiscard]] Corrections corrections() {
    return {.values = values_.data(), .weights = weights_.data(), .width = width};
  }

  /// Was the candidate in this cell accepted?
  [[nodiscard]] bool accepted(std::uint32_t row, std::uint32_t column) const {
    return weights_[place(row, column)] == 0.5f;
  }

  std::vector<float> values_ = std::vector<float>(std::size_t{width} * width, 0.0f);
  std::vector<float> weights_ = std::vector<float>(std::size_t{width} * width, 0.0f);
  std::vector<Candidate> candidates_;
};

TEST_F(Candidates, AreAcceptedIfTheyHaveAWeight) {
  add(1, 2, 0.3f);
  add(3, 2, 0.3f, 0);

  accept(candidates_, corrections());

  EXPECT_TRUE(accepted(1, 2));
  EXPECT_EQ(values_[place(1, 2)], 0.3f);
  EXPECT_EQ(weights_[place(3, 2)], 0);
}

TEST_F(Candidates, AreConfirmedByASimilarNeighbour) {
  set(2, 2, 0.15f);
  add(3, 3, 0.3f);   // 15 cm higher
  add(1, 1, 0.4f);   // 25 cm higher
  add(1, 3, -0.1f);  // 25 cm lower

  accept_confirmed(candidates_, corrections());

  EXPECT_TRUE(accepted(3, 3));
  EXPECT_EQ(values_[place(3, 3)], 0.3f);
  EXPECT_FALSE(accepted(1, 1));
  EXPECT_FALSE(accepted(1, 3));
}

TEST_F(Candidates, AreNotConfirmedWithoutANeighbour) {
  set(2, 0, 0.3f);
  add(2, 2, 0.3f);

  accept_confirmed(candidates_, corrections());

  EXPECT_FALSE(accepted(2, 2));
}

TEST_F(Candidates, AreNotConfirmedIfMoreNeighboursAreMuchLower) {
  const auto accepted_with = [&](int lower) {
    values_.assign(values_.size(), 0.0f);
    weights_.assign(weights_.size(), 0.0f);
    candidates_.clear();
    set(1, 1, 0.35f);
    set(1, 2, 0.3f);
    for (int i = 0; i < lower; ++i) set(3, 1 + static_cast<std::uint32_t>(i), 0.0f);
    set(2, 1, 0.9f);  // much higher: has no vote
    add(2, 2, 0.4f);
    accept_confirmed(candidates_, corrections());
    return accepted(2, 2);
  };

  EXPECT_TRUE(accepted_with(0));
  EXPECT_TRUE(accepted_with(2));
  EXPECT_FALSE(accepted_with(3));
}

TEST_F(Candidates, ConfirmANeighbourOnce) {
  set(2, 0, 0.1f);
  add(2, 1, 0.25f);
  add(2, 2, 0.4f);
  add(2, 3, 0.55f);

  accept_confirmed(candidates_, corrections());

  EXPECT_TRUE(accepted(2, 1));
  EXPECT_TRUE(accepted(2, 2));
  EXPECT_FALSE(accepted(2, 3));
}

TEST_F(Candidates, HaveNoNeighboursBeyondTheEdges) {
  set(0, 5, 0.3f);
  set(5, 0, 0.3f);
  add(1, 0, 0.3f);  // follows (0, 5) in memory
  add(4, 5, 0.3f);  // precedes (5, 0)
  add(0, 0, 0.3f);
  add(5, 5, 0.3f);

  accept_confirmed(candidates_, corrections());

  for (const Candidate& candidate : candidates_) EXPECT_EQ(weights_[candidate.place], 0);
}

TEST_F(Candidates, AreConfirmedInAnyOrder) {
  std::mt19937 random(1);
  const auto fill = [&] {
    values_.assign(values_.size(), 0.0f);
    weights_.assign(weights_.size(), 0.0f);
    for (std::uint32_t i = 0; i < width; ++i) set(i, i, 0.05f * static_cast<float>(i));
  };
  for (std::uint32_t i = 0; i < width * width; ++i) {
    if (i % (width + 1) != 0) add(i / width, i % width, 0.01f * static_cast<float>(random() % 60));
  }
  fill();
  accept_confirmed(candidates_, corrections());
  const std::vector<float> expected = values_;
  EXPECT_GT(std::ranges::count(weights_, 0.5f), 3);

  for (int repeat = 0; repeat < 20; ++repeat) {
    std::ranges::shuffle(candidates_, random);
    fill();
    accept_confirmed(candidates_, corrections());
    EXPECT_EQ(values_, expected);
  }
}

}  // namespace
}  // namespace flagstone::surface
