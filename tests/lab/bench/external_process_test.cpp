// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "lab/bench/external_tool.hpp"

namespace flagstone::bench {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// The message of the ExternalToolError that `work` throws.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const ExternalToolError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExternalProcess, AnswersLinesOneByOne) {
  ExternalProcess tool(
      {"sh", "-c", "while read word number; do printf '%s %s\\n' $number $word; done"});

  tool.send_line("run 3");
  tool.send_line("scan 40");

  EXPECT_EQ(tool.read_line(60s), "3 run");
  EXPECT_EQ(tool.read_line(60s), "40 scan");
}

TEST(ExternalProcess, RunsOnOneThread) {
  ExternalProcess tool({"sh", "-c", "printf '%s\\n' $OMP_NUM_THREADS"});

  EXPECT_EQ(tool.read_line(60s), "1");
}

TEST(ExternalProcess, NamesAProgramThatDoesNotExist) {
  EXPECT_THAT(error_of([] { ExternalProcess tool({"no-such-program"}); }),
              HasSubstr("no-such-program cannot be started: No such file"));
}

TEST(ExternalProcess, ReportsAnExitToReaderAndWriter) {
  ExternalProcess tool({"true"});

  EXPECT_EQ(error_of([&] { tool.read_line(60s); }), "its worker exited early");
  EXPECT_EQ(error_of([&] { tool.send_line("run 1"); }), "its worker exited early");
}

TEST(ExternalProcess, TimesOutWithoutAnAnswer) {
  ExternalProcess tool({"sleep", "600"});

  EXPECT_EQ(error_of([&] { tool.read_line(1s); }), "its worker did not answer within 1 s");
}

TEST(ExternalProcess, RejectsAnEndlessLine) {
  ExternalProcess tool({"sh", "-c", "while :; do printf 0123456789; done"});

  EXPECT_EQ(error_of([&] { tool.read_line(60s); }),
            "its worker printed a line of more than 1000 bytes");
}

}  // namespace
}  // namespace flagstone::bench
