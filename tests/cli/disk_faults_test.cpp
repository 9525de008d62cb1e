// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Files that are deleted or truncated during a run, a full disk, and a run that is killed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/file_size_limit.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t points_of_a_scan = 20000;
constexpr std::size_t label_bytes = 4 * points_of_a_scan;

/// A run over 2,000 names of one scan: far more than are done when the test changes the files.
class DiskFault : public testing::Test {
 protected:
  static constexpr std::size_t count = 2000;

  DiskFault() {
    put_scan(first(), small_scan(points_of_a_scan));
    for (std::size_t i = 1; i < count; ++i) {
      fs::create_hard_link(first(), folder_ / ("scans/" + std::to_string(i) + ".bin"));
    }
  }

  [[nodiscard]] fs::path first() const { return folder_ / "scans/0.bin"; }
  [[nodiscard]] std::vector<std::string> arguments() const {
    return {"segment",   (folder_ / "scans").string(),
            "--output",  (folder_ / "out").string(),
            "--threads", "2"};
  }

  /// Number of label files; expects each to be complete.
  [[nodiscard]] std::size_t whole_label_files() const {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out")) {
      if (entry.path().extension() != ".label") continue;
      EXPECT_EQ(entry.file_size(), label_bytes) << entry.path();
      ++files;
    }
    return files;
  }

  io::TemporaryFolder folder_;
};

/// Expects every line to name a scan.
void expect_lines_name_scans(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) {
    EXPECT_THAT(line, AllOf(testing::StartsWith("flagstone: "), HasSubstr(".bin: ")));
  }
}

TEST_F(DiskFault, ReportsEachDeletedScanOnOneLineAndSegmentsTheOthers) {
  CommandProcess command(arguments());
  ASSERT_TRUE(command.prints_something());

  for (std::size_t i = 0; i < count; ++i) {
    if (i % 4 != 0) fs::remove(folder_ / ("scans/" + std::to_string(i) + ".bin"));
  }
  const Outcome outcome = command.finish();

  EXPECT_EQ(outcome.exit_code, 1);
  const std::vector<std::string> lines = lines_of(outcome.err);
  expect_lines_name_scans(lines);
  EXPECT_THAT(lines, testing::Not(IsEmpty()));
  EXPECT_EQ(lines.size() + whole_label_files(), count);
}

TEST_F(DiskFault, ReportsEachTruncatedScanOnOneLine) {
  CommandProcess command(arguments());
  ASSERT_TRUE(command.prints_something());

  fs::resize_file(first(), 16 * points_of_a_scan - 5);
  const Outcome outcome = command.finish();

  EXPECT_EQ(outcome.exit_code, 1);
  const std::vector<std::string> lines = lines_of(outcome.err);
  expect_lines_name_scans(lines);
  EXPECT_THAT(lines, testing::Each(HasSubstr(": byte ")));
  EXPECT_EQ(lines.size() + whole_label_files(), count);
}

TEST_F(DiskFault, LeavesNoPartialFileWhenKilledAndCanBeRunAgain) {
  CommandProcess command(arguments());
  ASSERT_TRUE(command.prints_something());

  command.send(SIGKILL);
  EXPECT_EQ(command.finish().exit_code, -1);
  EXPECT_LE(whole_label_files(), count);

  const Outcome again = run(arguments());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(whole_label_files(), count);
}

TEST(FullDisk, ReportsEachOutputOnOneLineAndLeavesNoPartialFile) {
  for (const std::string format : {"label", "npy", "pcd", "ply"}) {
    const io::TemporaryFolder folder;
    put_scan(folder / "scan.bin");
    const io::FileSizeLimit limit(1000);

    const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                                 (folder / "out").string(), "--format", format});

    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_THAT(outcome.err,
                AllOf(is_one_line_with("out/scan." + format + ": "), HasSubstr("File too large")));
    EXPECT_THAT(names_below(folder / "out"), IsEmpty());
  }
}

TEST(FullDisk, KeepsTheLabelsOfThePreviousRun) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  const std::vector<std::string> arguments = {"segment", (folder / "scan.bin").string(), "--output",
                                              (folder / "out").string()};
  ASSERT_EQ(run(arguments).exit_code, 0);
  const auto before = files_below(folder / "out");

  const io::FileSizeLimit limit(1000);
  EXPECT_EQ(run(arguments).exit_code, 1);

  EXPECT_EQ(files_below(folder / "out"), before);
}

TEST(FullDisk, EndsASimulationWithOneLineAndNoPartialFile) {
  const io::TemporaryFolder folder;
  const io::FileSizeLimit limit(20000);

  const Outcome outcome = run({"simulate", "--scene", "flat_street", "--frames", "2", "--output",
                               (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(is_one_line_with(folder.path().string()), HasSubstr("File too large")));
  for (const std::string& name : names_below(folder / "out")) {
    EXPECT_THAT(name, testing::Not(EndsWith(".bin")));
    EXPECT_THAT(name, testing::Not(EndsWith(".tmp")));
  }
}

}  // namespace
}  // namespace flagstone::cli
