// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t points = 20000;
constexpr std::size_t many_scans = 3000;

/// Many names of one file: far more scans than can be done before the signal arrives.
void put_many_scans(const fs::path& folder) {
  put_scan(folder / "0.bin", small_scan(points));
  for (std::size_t i = 1; i < many_scans; ++i) {
    fs::create_hard_link(folder / "0.bin", folder / (std::to_string(i) + ".bin"));
  }
}

class Interrupt : public testing::TestWithParam<int> {};

TEST_P(Interrupt, FinishesTheScansInProgressAndReportsTheirNumber) {
  const io::TemporaryFolder folder;
  put_many_scans(folder / "scans");
  CommandProcess command({"segment", (folder / "scans").string(), "--output",
                          (folder / "out").string(), "--threads", "2"});
  ASSERT_TRUE(command.prints_something());

  command.send(GetParam());
  const Outcome outcome = command.finish();

  EXPECT_EQ(outcome.exit_code, 1);
  const auto files = files_below(folder / "out");
  EXPECT_GT(files.size(), 0U);
  EXPECT_LT(files.size(), many_scans);
  EXPECT_THAT(outcome.err, is_one_line_with("interrupted: " + std::to_string(files.size()) +
                                            " of 3000 scans are segmented"));
  for (const auto& [name, contents] : files) {
    EXPECT_TRUE(name.ends_with(".label")) << name;
    EXPECT_EQ(contents.size(), 4 * points) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM),
                         [](const auto& signal) {
                           return std::string(signal.param == SIGINT ? "Interrupt" : "Terminate");
                         });

}  // namespace
}  // namespace flagstone::cli
