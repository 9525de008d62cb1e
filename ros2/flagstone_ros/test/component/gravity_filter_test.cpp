// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "gravity_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace flagstone_ros {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Optional;

auto is_up(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, 1e-9), DoubleNear(y, 1e-9), DoubleNear(z, 1e-9));
}

TEST(GravityFilter, IsUnknownBeforeTheFirstSample) {
  EXPECT_EQ(GravityFilter().up(), std::nullopt);
}

TEST(GravityFilter, StartsWithTheFirstSample) {
  GravityFilter filter;

  filter.add({1, 2, 9}, 100, "imu", 1);

  EXPECT_THAT(filter.up(), Optional(is_up(1, 2, 9)));
  EXPECT_EQ(filter.frame(), "imu");
}

TEST(GravityFilter, DecaysToOneOverEInItsTimeConstant) {
  GravityFilter filter;
  filter.add({1, 0, 10}, 100, "imu", 0.5);

  filter.add({0, 0, 10}, 100.5, "imu", 0.5);

  EXPECT_THAT(filter.up(), Optional(is_up(std::exp(-1), 0, 10)));
}

TEST(GravityFilter, WithATimeConstantOfZeroUsesTheLastSample) {
  GravityFilter filter;
  filter.add({1, 0, 10}, 100, "imu", 0);

  filter.add({0, 2, 10}, 100.01, "imu", 0);

  EXPECT_THAT(filter.up(), Optional(is_up(0, 2, 10)));
}

TEST(GravityFilter, IgnoresSamplesThatAreZeroNotFiniteOrOld) {
  GravityFilter filter;
  filter.add({0, 0, 10}, 100, "imu", 1);

  EXPECT_FALSE(filter.add({0, 0, 0}, 100.1, "imu", 1));
  EXPECT_FALSE(filter.add({0, std::numeric_limits<double>::quiet_NaN(), 1}, 100.1, "imu", 1));
  EXPECT_FALSE(filter.add({5, 0, 10}, 99.9, "imu", 1));
  EXPECT_THAT(filter.up(), Optional(is_up(0, 0, 10)));
}

TEST(GravityFilter, StartsAgainAfterAGapAJumpBackOrAnotherFrame) {
  GravityFilter filter;
  filter.add({0, 0, 10}, 100, "imu", 1);

  filter.add({1, 0, 10}, 102, "imu", 1);
  EXPECT_THAT(filter.up(), Optional(is_up(1, 0, 10)));
  filter.add({2, 0, 10}, 5, "imu", 1);
  EXPECT_THAT(filter.up(), Optional(is_up(2, 0, 10)));
  filter.add({3, 0, 10}, 5.1, "other", 1);
  EXPECT_THAT(filter.up(), Optional(is_up(3, 0, 10)));
}

}  // namespace
}  // namespace flagstone_ros
