// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(DemoCommand, WritesTheFilesItNamesAndIsDeterministicForASeed) {
  const io::TemporaryFolder folder;

  const Outcome outcome = run({"demo", "--output", (folder / "one").string(), "--seed", "5"});
  const Outcome again = run({"demo", "--output", (folder / "two").string(), "--seed", "5"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(again.exit_code, 0) << again.err;
  for (const char* row :
       {"points", "ground", "patches", "precision", "recall", "F1", "heights", "time"}) {
    EXPECT_THAT(outcome.out, ContainsRegex("\n  " + std::string(row) + " +[0-9]"));
  }
  auto one = files_below(folder / "one");
  auto two = files_below(folder / "two");
  EXPECT_THAT(
      names_below(folder / "one"),
      ElementsAre("000000-compared.png", "000000-surface.png", "000000.png", "labels/000000.label",
                  "predictions/000000.label", "velodyne/000000.bin"));
  for (const auto& [name, contents] : one) {
    EXPECT_THAT(outcome.out, HasSubstr((folder / ("one/" + name)).string()));
    EXPECT_EQ(contents == two[name], true) << name;
  }
  for (const char* picture : {"000000.png", "000000-compared.png", "000000-surface.png"}) {
    EXPECT_THAT(one[picture], StartsWith("\x89PNG")) << picture;
  }
  const std::size_t points = one["velodyne/000000.bin"].size() / 16;
  EXPECT_GT(points, 50000U);
  EXPECT_EQ(one["labels/000000.label"].size(), 4 * points);
  EXPECT_EQ(one["predictions/000000.label"].size(), 4 * points);
}

TEST(DemoCommand, RejectsASeedThatIsNotA64BitNumber) {
  const io::TemporaryFolder folder;
  const std::vector<std::string> seeds = {"-1", "18446744073709551616", "1e3",
                                          std::string(309, '9')};
  for (const std::string& seed : seeds) {
    const Outcome outcome = run({"demo", "--output", (folder / "out").string(), "--seed", seed});

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, is_one_line_with("--seed: '" + seed.substr(0, 32)));
    EXPECT_THAT(outcome.err, HasSubstr("(expected 0 to 18446744073709551615)"));
    EXPECT_LT(outcome.err.size(), 200U);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(DemoCommand, ReportsAnOutputDirectoryThatCannotBeCreated) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "taken", "mine");

  const Outcome outcome = run({"demo", "--output", (folder / "taken").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("cannot be created"));
}

}  // namespace
}  // namespace flagstone::cli
