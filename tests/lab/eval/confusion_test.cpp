// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/confusion.hpp"

#include <gtest/gtest.h>

#include <array>

namespace flagstone::eval {
namespace {

TEST(Confusion, ATinyCaseComputedByHand) {
  using enum Truth;
  constexpr std::array labels = {Label::ground, Label::ground,    Label::ground, Label::nonground,
                                 Label::noise,  Label::nonground, Label::ground};
  constexpr std::array truth = {ground, ground, not_ground, ground, ground, not_ground, ignored};

  const Confusion confusion = compare(labels, truth);

  EXPECT_EQ(confusion.true_positives, 2u);
  EXPECT_EQ(confusion.false_positives, 1u);
  EXPECT_EQ(confusion.false_negatives, 2u);
  EXPECT_EQ(confusion.true_negatives, 1u);
  EXPECT_DOUBLE_EQ(confusion.precision(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(confusion.recall(), 0.5);
  EXPECT_DOUBLE_EQ(confusion.f1(), 4.0 / 7);
  EXPECT_DOUBLE_EQ(confusion.accuracy(), 0.5);
}

TEST(Confusion, WhatAMethodDoesNotJudgeCountsAsNotGround) {
  constexpr std::array labels = {Label::noise, Label::out_of_range, Label::invalid};
  constexpr std::array truth = {Truth::ground, Truth::not_ground, Truth::ground};

  const Confusion confusion = compare(labels, truth);

  EXPECT_EQ(confusion.false_negatives, 2u);
  EXPECT_EQ(confusion.true_negatives, 1u);
}

TEST(Confusion, NothingToFindAndNothingFoundIsPerfect) {
  const Confusion confusion = compare({}, {});

  EXPECT_EQ(confusion.precision(), 1.0);
  EXPECT_EQ(confusion.recall(), 1.0);
  EXPECT_EQ(confusion.f1(), 1.0);
}

}  // namespace
}  // namespace flagstone::eval
