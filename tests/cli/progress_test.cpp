// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flagstone::cli {
namespace {

using namespace std::chrono_literals;

TEST(Progress, TheBarGrowsWithTheShareThatIsDone) {
  EXPECT_EQ(progress_text(0, 4, 0s), "[                              ] 0 of 4 scans");
  EXPECT_EQ(progress_text(1, 2, 5s), "[###############               ] 1 of 2 scans, 5 s left");
  EXPECT_EQ(progress_text(4, 4, 9s), "[##############################] 4 of 4 scans");
}

TEST(Progress, TheTimeLeftIsWhatTheDoneOnesTookEach) {
  EXPECT_THAT(progress_text(40, 100, 8s), testing::EndsWith(" 40 of 100 scans, 12 s left"));
  EXPECT_THAT(progress_text(1, 11, 12.5s), testing::EndsWith(", 2 min 05 s left"));
  EXPECT_THAT(progress_text(1, 3601, 2s), testing::EndsWith(", 2 h 00 min left"));
}

TEST(Progress, NoScansAreAllDone) {
  EXPECT_EQ(progress_text(0, 0, 0s), "[##############################] 0 of 0 scans");
}

}  // namespace
}  // namespace flagstone::cli
