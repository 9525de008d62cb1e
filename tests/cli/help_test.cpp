// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "flagstone/version.hpp"

namespace flagstone::cli {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string help_of(const std::vector<std::string>& command = {}) {
  std::vector<std::string> arguments = command;
  arguments.emplace_back("--help");
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

/// The commands that `flagstone --help` lists: two spaces, the name, spaces, a sentence.
std::vector<std::string> listed_commands() {
  std::vector<std::string> names;
  for (const std::string& line : lines_of(help_of())) {
    std::smatch match;
    if (std::regex_match(line, match, std::regex("  ([a-z]+)  +[A-Z].*\\."))) {
      names.push_back(match[1]);
    }
  }
  return names;
}

TEST(Help, ListsEveryCommandOnOneLine) {
  EXPECT_THAT(listed_commands(), testing::ElementsAre("segment", "bag", "ray", "doctor", "info",
                                                      "eval", "sweep", "bench", "demo", "simulate",
                                                      "config", "sensors", "completion", "manual"));
}

TEST(Help, OfEveryCommandHasPurposeUsageExamplesOptionsAndExitCodesInThisOrder) {
  for (const std::string& command : listed_commands()) {
    const std::string help = help_of({command});

    EXPECT_THAT(lines_of(help)[0], ContainsRegex("^[A-Z].*\\.$")) << command;
    std::size_t at = 0;
    for (const std::string& part :
         {"\nUsage: flagstone " + command + " [OPTIONS]", std::string("\nExamples:\n"),
          "\n  flagstone " + command + " ", std::string("\nOther:\n"),
          std::string("\n  -h, --help  "), std::string("\nExit codes: 0, ")}) {
      const std::size_t found = help.find(part, at);
      ASSERT_NE(found, std::string::npos) << command << part;
      at = found;
    }
  }
}

TEST(Help, FitsEightyColumnsAndHasNoTypeTags) {
  std::vector<std::string> commands = listed_commands();
  for (const std::string& command : commands) {
    const std::string help = help_of({command});
    for (const std::string& line : lines_of(help)) EXPECT_LE(line.size(), 80U) << line;
    for (const char* tag : {"ENUM", "TEXT", "INT", "UINT", "FLOAT", " ...", "REQUIRED", "Needs:"}) {
      EXPECT_THAT(help, Not(HasSubstr(tag))) << command;
    }
  }
}

TEST(Help, NotesDefaultsAndRequirementsAfterTheDescription) {
  const std::string help = help_of({"segment"});

  EXPECT_THAT(help, ContainsRegex("\n  -o, --output DIR +Output directory"));
  EXPECT_THAT(help, HasSubstr("(required)"));
  EXPECT_THAT(help, HasSubstr("(repeatable)"));
  EXPECT_THAT(help, HasSubstr("(needs --image)"));
  EXPECT_THAT(help, ContainsRegex("\n  --format FORMAT +Output format \\(default: label\\)\n"));
  EXPECT_THAT(help, ContainsRegex("\n +split +separate clouds"));
}

TEST(Help, PrintsTheVersionOfTheLibrary) {
  const Outcome outcome = run({"--version"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out, FLAGSTONE_VERSION "\n");
}

}  // namespace
}  // namespace flagstone::cli
