// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A directory with two good scans and, between them, a scan that is truncated in its third point.
class AmongGoodScans : public testing::Test {
 protected:
  AmongGoodScans() {
    put_scan(folder_ / "scans/a.bin");
    io::put_file(folder_ / "scans/b.bin", std::string(2 * 16 + 5, 'x'));
    put_scan(folder_ / "scans/c.bin");
  }

  [[nodiscard]] Outcome segment(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"segment", (folder_ / "scans").string(), "--output",
                                          (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_F(AmongGoodScans, ReportsABadFileOnOneLineAndSegmentsTheOthers) {
  const Outcome outcome = segment();

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              is_one_line_with("flagstone: " + (folder_ / "scans/b.bin").string() + ": byte 32: "));
  EXPECT_THAT(lines_of(outcome.out),
              ElementsAre(HasSubstr("a.bin: 4000 points"), HasSubstr("c.bin: 4000 points"),
                          HasSubstr("2 of 3 scans segmented"), HasSubstr(" scans per second")));
  EXPECT_THAT(names_below(folder_ / "out"), ElementsAre("a.label", "c.label"));
}

TEST_F(AmongGoodScans, ReportsABadFileAsAJsonObjectInOrder) {
  const Outcome outcome = segment({"--json"});

  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(json::parse(lines[0])["points"], 4000);
  EXPECT_THAT(json::parse(lines[1])["error"].get<std::string>(), HasSubstr("byte 32"));
  EXPECT_EQ(json::parse(lines[2])["points"], 4000);
}

TEST(SegmentFailure, ReportsAMissingFileOnOneLine) {
  const io::TemporaryFolder folder;

  const Outcome outcome =
      run({"segment", (folder / "no.bin").string(), "--output", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with((folder / "no.bin").string()));
}

TEST(SegmentFailure, ReportsAnUnknownExtensionAndTheKnownOnes) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "scan.las", "LASF");

  const Outcome outcome =
      run({"segment", (folder / "scan.las").string(), "--output", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("scan.las"), HasSubstr(".pcd")));
}

TEST(SegmentFailure, ReportsAFileNameWithALineBreakOnOneLine) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "two\nlines.bin", "x");

  const Outcome outcome =
      run({"segment", (folder / "two\nlines.bin").string(), "--output", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("two\\x0alines.bin: byte 0"));
}

TEST(SegmentFailure, ReportsAnOutputDirectoryThatCannotBeCreated) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  io::put_file(folder / "taken", "mine");

  const Outcome outcome =
      run({"segment", (folder / "scan.bin").string(), "--output", (folder / "taken").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with((folder / "taken").string() + ": cannot be created: "));
  EXPECT_EQ(io::contents_of(folder / "taken"), "mine");
}

TEST(SegmentFailure, ReportsAnUnwritableOutputAndLeavesNothing) {
  for (const std::string format : {"label", "npy", "pcd", "ply"}) {
    const io::TemporaryFolder folder;
    put_scan(folder / "scan.bin");
    fs::create_directories(folder / ("out/scan." + format));  // a directory in place of the file

    const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                                 (folder / "out").string(), "--format", format});

    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err, is_one_line_with("out/scan." + format + ": is a directory"));
    EXPECT_THAT(names_below(folder / "out"), ElementsAre());
  }
}

TEST(SegmentFailure, ReportsUnwritableStandardOutput) {
  const io::TemporaryFolder folder;
  for (const char* name : {"a.bin", "b.bin", "c.bin"})
    put_scan(folder / (std::string("scans/") + name));

  const Outcome outcome = CommandProcess({"segment", (folder / "scans").string(), "--output",
                                          (folder / "out").string(), "--threads", "2", "--json"},
                                         "/dev/full")
                              .finish();

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("standard output: cannot be written"));
}

}  // namespace
}  // namespace flagstone::cli
