// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "throttle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flagstone_ros {
namespace {

using ::testing::Optional;

TEST(Throttle, LetsTheFirstLineOfEachProblemPass) {
  Throttle throttle(5);

  EXPECT_THAT(throttle.line("transform", "no transform", 100),
              Optional(std::string("no transform")));
  EXPECT_THAT(throttle.line("cloud", "no fields", 100), Optional(std::string("no fields")));
}

TEST(Throttle, WithholdsLinesOfTheSameProblemForItsPeriod) {
  Throttle throttle(5);
  static_cast<void>(throttle.line("cloud", "no fields", 100));

  EXPECT_EQ(throttle.line("cloud", "no fields", 104.9), std::nullopt);
  EXPECT_EQ(throttle.line("cloud", "no x", 104.95), std::nullopt);
  EXPECT_THAT(throttle.line("cloud", "no y", 105.1),
              Optional(std::string("no y [2 more since the last line]")));
  EXPECT_EQ(throttle.line("cloud", "no y", 106), std::nullopt);
}

}  // namespace
}  // namespace flagstone_ros
