// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using testing::ElementsAre;

/// The scan with the labels of the library.
io::Cloud labelled_scan() {
  const io::Cloud scan = small_scan();
  io::Cloud labelled;
  EXPECT_TRUE(io::with_labels(scan, labels_of(scan), labelled).ok());
  return labelled;
}

class SegmentFormat : public testing::TestWithParam<std::string> {};

TEST_P(SegmentFormat, KeepsEveryFieldAndAddsTheLabel) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");

  const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                               (folder / "out").string(), "--format", GetParam()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder / "out"), ElementsAre("scan." + GetParam()));
  const io::Cloud written = scan_of(folder / ("out/scan." + GetParam()));
  const io::Cloud expected = labelled_scan();
  EXPECT_TRUE(std::ranges::equal(written.fields(), expected.fields()));
  EXPECT_TRUE(std::ranges::equal(written.bytes(), expected.bytes()));
}

INSTANTIATE_TEST_SUITE_P(All, SegmentFormat, testing::Values("npy", "pcd", "ply"),
                         [](const auto& format) { return format.param; });

TEST(SegmentU8, WritesOneBytePerPointInANumPyArray) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");

  const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                               (folder / "out").string(), "--format", "u8"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder / "out"), ElementsAre("scan.label.npy"));
  EXPECT_LT(std::filesystem::file_size(folder / "out/scan.label.npy"), 4000 + 200U);
  std::vector<Label> labels;
  ASSERT_TRUE(io::read_labels(folder / "out/scan.label.npy", 4000, labels).ok());
  EXPECT_EQ(labels, labels_of(small_scan()));
}

TEST(SegmentU8, CanBeAReference) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  const std::string scan = (folder / "scan.bin").string();
  const std::string truth = (folder / "truth").string();
  run({"segment", scan, "--output", truth, "--format", "u8", "--label-map", "semantic-kitti"});

  const Outcome outcome =
      run({"segment", scan, "--output", (folder / "out").string(), "--reference", truth});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("F1 100.00 % (patchwork)"));
}

/// The points of `scan` whose label is ground, or is not ground.
io::Cloud part_of(const io::Cloud& scan, bool ground) {
  std::vector<std::uint8_t> mask;
  for (const Label label : labels_of(scan)) mask.push_back((label == Label::ground) == ground);
  io::Cloud part;
  EXPECT_TRUE(io::select_where(scan, mask, part).ok());
  return part;
}

class SegmentSplit : public testing::TestWithParam<std::string> {};

TEST_P(SegmentSplit, SplitsThePointsAndKeepsFieldsAndFormat) {
  const std::string extension = GetParam();
  const io::TemporaryFolder folder;
  put_scan(folder / ("scan" + extension));
  const io::Cloud scan = scan_of(folder / ("scan" + extension));

  const Outcome outcome = run({"segment", (folder / ("scan" + extension)).string(), "--output",
                               (folder / "out").string(), "--format", "split"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder / "out"),
              ElementsAre("scan.ground" + extension, "scan.nonground" + extension));
  const io::Cloud ground = scan_of(folder / ("out/scan.ground" + extension));
  const io::Cloud nonground = scan_of(folder / ("out/scan.nonground" + extension));
  EXPECT_EQ(ground.size() + nonground.size(), scan.size());
  EXPECT_GT(ground.size(), 0U);
  EXPECT_GT(nonground.size(), 0U);
  EXPECT_TRUE(std::ranges::equal(ground.fields(), scan.fields()));
  EXPECT_TRUE(std::ranges::equal(nonground.fields(), scan.fields()));
  EXPECT_TRUE(std::ranges::equal(ground.bytes(), part_of(scan, true).bytes()));
  EXPECT_TRUE(std::ranges::equal(nonground.bytes(), part_of(scan, false).bytes()));
}

/// 4,000 points of four floats become 3,200 of five, because .pcd.bin has five floats per point.
INSTANTIATE_TEST_SUITE_P(All, SegmentSplit,
                         testing::Values(".bin", ".pcd.bin", ".PCD.BIN", ".pcd", ".ply", ".npy"),
                         [](const auto& split) {
                           std::string name = split.param;
                           std::ranges::replace(name, '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace flagstone::cli
