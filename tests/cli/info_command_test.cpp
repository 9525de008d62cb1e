// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

/// Ten points: two all zero, one not finite, seven on the x axis at 3, 4, ... 9 m.
io::Cloud ten_points() {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> values = {0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 1, 1, nan, 0.5f};
  for (int x = 3; x < 10; ++x) {
    values.insert(values.end(), {static_cast<float>(x), 0, -1.5f, 0.25f});
  }
  io::Cloud scan;
  EXPECT_TRUE(io::Cloud::from_floats(values, 4, scan).ok());
  return scan;
}

class InfoFormat : public testing::TestWithParam<std::string> {};

TEST_P(InfoFormat, ShowsCountsFieldsBoundsAndHistograms) {
  const io::TemporaryFolder folder;
  const std::string file = (folder / ("scan" + GetParam())).string();
  put_scan(file, ten_points());

  const Outcome outcome = run({"info", file});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const std::vector<std::string> lines = lines_of(outcome.out);
  EXPECT_THAT(lines, Contains(file));
  EXPECT_THAT(lines, Contains("points               10, 16 bytes each"));
  EXPECT_THAT(lines, Contains("not finite           1 (10.0 %)"));
  EXPECT_THAT(lines, Contains("missing returns      2 (20.0 %)"));
  EXPECT_THAT(lines, Contains("  x                  float32    0 .. 9"));
  EXPECT_THAT(lines, Contains("  z                  float32    -1.5 .. 0"));
  EXPECT_THAT(lines, Contains("  intensity          float32    0.25 .. 0.5"));
  EXPECT_THAT(lines, Contains(AllOf(StartsWith("            2 .. 5 m  ###"), HasSubstr("28.6 %"))));
  EXPECT_THAT(lines,
              Contains(AllOf(StartsWith("           5 .. 10 m  ####"), HasSubstr("71.4 %"))));
  EXPECT_THAT(lines, Contains(AllOf(HasSubstr("-1.5 .. "), HasSubstr("100.0 %"))));
}

INSTANTIATE_TEST_SUITE_P(All, InfoFormat, testing::Values(".bin", ".pcd", ".ply", ".npy"),
                         [](const auto& format) { return format.param.substr(1); });

TEST(InfoCommand, ReportsNoPointsForAnEmptyFile) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "empty.bin", "");

  const Outcome outcome = run({"info", (folder / "empty.bin").string()});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(lines_of(outcome.out), Contains("points               0, 16 bytes each"));
  EXPECT_THAT(outcome.out, HasSubstr("no points"));
}

TEST(InfoCommand, ReportsABrokenFileOnOneLineAndShowsTheOthers) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "broken.pcd", "VERSION 0.7\nFIELDS x y\n");
  put_scan(folder / "good.bin", ten_points());

  const Outcome outcome =
      run({"info", (folder / "broken.pcd").string(), (folder / "good.bin").string()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with((folder / "broken.pcd").string() + ": byte "));
  EXPECT_THAT(lines_of(outcome.out), Contains("points               10, 16 bytes each"));
}

TEST(InfoCommand, ShowsTheLargestFloats) {
  const io::TemporaryFolder folder;
  io::Cloud scan;
  ASSERT_TRUE(io::Cloud::from_floats(std::vector<float>(4, 3e38f), 4, scan).ok());
  put_scan(folder / "scan.bin", scan);

  const Outcome outcome = run({"info", (folder / "scan.bin").string()});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(lines_of(outcome.out), Contains("  z                  float32    3e+38 .. 3e+38"));
}

TEST(InfoCommand, ReadsTheGivenNumberOfColumns) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "scan.bin", std::string(6 * 7 * 4, '\0'));

  EXPECT_THAT(lines_of(run({"info", (folder / "scan.bin").string(), "--columns", "6"}).out),
              Contains("points               7, 24 bytes each"));
}

}  // namespace
}  // namespace flagstone::cli
