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

using testing::Each;
using testing::HasSubstr;
using testing::StartsWith;

std::string page_of(const std::vector<std::string>& command = {}) {
  std::vector<std::string> arguments = {"manual"};
  arguments.insert(arguments.end(), command.begin(), command.end());
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

TEST(Manual, HasTheSectionsOfAManualPageInTheirOrder) {
  const std::string page = page_of({"simulate"});

  EXPECT_THAT(page, StartsWith(R"(.TH FLAGSTONE\-SIMULATE 1 "" "flagstone )" FLAGSTONE_VERSION));
  std::size_t at = 0;
  for (const char* section :
       {"NAME\nflagstone\\-simulate \\- Simulate a sequence", "SYNOPSIS", "DESCRIPTION", "OPTIONS",
        "SCENES", "EXIT STATUS", "EXAMPLES", "SEE ALSO\n.BR flagstone (1),"}) {
    const std::size_t found = page.find(std::string("\n.SH ") + section, at);
    ASSERT_NE(found, std::string::npos) << section;
    at = found;
  }
}

TEST(Manual, OfTheProgramListsItsCommands) {
  EXPECT_THAT(page_of(), HasSubstr("\n.TP\n\\fBflagstone\\-segment\\fR(1)\nLabel every point"));
}

TEST(Manual, ShowsOptionsWithTheirValuesAndTables) {
  const std::string page = page_of({"segment"});

  EXPECT_THAT(page, HasSubstr("\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIDIR\\fR\nOutput dir"));
  EXPECT_THAT(page, HasSubstr("\n.RS\n.TP\n\\fBlabel\\fR\nlabels only"));
}

TEST(Manual, ContainsEveryOptionOfTheHelp) {
  for (const char* command : {"segment", "map", "eval", "simulate"}) {
    const std::string page = page_of({command});
    for (const std::string& line : lines_of(run({command, "--help"}).out)) {
      if (!line.starts_with("  --")) continue;
      std::string option = line.substr(4, line.find(' ', 4) - 4);
      for (std::size_t at = 0; (at = option.find('-', at)) != std::string::npos; at += 2) {
        option.insert(at, "\\");
      }
      EXPECT_THAT(page, HasSubstr("\\fB\\-\\-" + option + "\\fR")) << command;
    }
  }
}

/// A line that begins with a dot or a quote would be a request to roff.
TEST(Manual, HasNoRequestsButThoseOfManualPages) {
  for (const char* command : {"segment", "simulate", "completion"}) {
    std::vector<std::string> requests;
    for (const std::string& line : lines_of(page_of({command}))) {
      EXPECT_THAT(line, testing::Not(StartsWith("'")));
      if (line.starts_with('.')) requests.push_back(line.substr(0, line.find(' ')));
    }
    EXPECT_THAT(requests, Each(testing::AnyOf(".TH", ".nh", ".ad", ".SH", ".SS", ".TP", ".PP",
                                              ".RS", ".RE", ".BR")));
  }
}

TEST(Manual, RejectsAnUnknownCommand) {
  const Outcome outcome = run({"manual", "segmnt"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("manual: no command is named 'segmnt' (expected segment, "));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean 'segment'?"));
}

}  // namespace
}  // namespace flagstone::cli
