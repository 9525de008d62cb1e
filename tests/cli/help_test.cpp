// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "flagstone/version.hpp"

namespace flagstone::cli {
namespace {

using testing::StartsWith;

TEST(Help, OfEveryCommandStartsWithAnExample) {
  for (const std::string command :
       {"segment", "simulate", "eval", "sweep", "bench", "demo", "info", "config", "sensors"}) {
    const Outcome outcome = run({command, "--help"});

    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    ASSERT_GE(lines_of(outcome.out).size(), 3U) << command;
    EXPECT_THAT(lines_of(outcome.out)[2], StartsWith("Example:  flagstone " + command));
  }
}

TEST(Help, OfTheWholeStartsWithAnExampleAndNamesTheCommands) {
  const Outcome outcome = run({"--help"});

  EXPECT_EQ(outcome.exit_code, 0);
  ASSERT_GE(lines_of(outcome.out).size(), 3U);
  EXPECT_THAT(lines_of(outcome.out)[2], StartsWith("Example:  flagstone segment"));
  for (const char* command : {"  segment ", "  simulate ", "  eval ", "  sweep ", "  bench ",
                              "  demo ", "  info ", "  config ", "  sensors "}) {
    EXPECT_THAT(outcome.out, testing::HasSubstr(command));
  }
}

TEST(Help, VersionIsTheLibrarys) {
  const Outcome outcome = run({"--version"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, FLAGSTONE_VERSION "\n");
}

}  // namespace
}  // namespace flagstone::cli
