// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/run_poses.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<ScanInput> named_scans(const std::vector<std::string>& names) {
  std::vector<ScanInput> scans;
  for (const std::string& name : names) {
    scans.push_back({.file = "velodyne/" + name + ".bin", .output_stem = "velodyne/" + name});
  }
  return scans;
}

std::vector<ScanInput> numbered_scans(std::size_t count, std::size_t first = 0) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("{:06}", first + i));
  return named_scans(names);
}

/// Poses at x = 0, 1, 2, ..., at 10 per second if `has_times`.
io::PoseFile straight_path(std::size_t count, bool has_times = false) {
  io::PoseFile file;
  file.format = has_times ? io::PoseFormat::tum : io::PoseFormat::kitti;
  file.has_times = has_times;
  for (std::size_t i = 0; i < count; ++i) {
    io::PoseLine line{.number = i + 1, .pose = Pose{}};
    line.pose->position[0] = static_cast<double>(i);
    if (has_times) line.time = 100 + 0.1 * static_cast<double>(i);
    file.poses.push_back(line);
  }
  return file;
}

/// x of each pose; NaN without a pose.
std::vector<double> x_of(const RunPoses& run) {
  std::vector<double> all;
  for (const ScanPose& scan : run.scans) {
    all.push_back(scan.pose ? scan.pose->position[0] : std::nan(""));
  }
  return all;
}

TEST(RunPoses, BelongToScansInTheirOrder) {
  const RunPoses run = pair_poses(straight_path(3), named_scans({"a", "b", "c"}), {});

  EXPECT_THAT(x_of(run), ElementsAre(0, 1, 2));
  EXPECT_THAT(run.notes, IsEmpty());
  EXPECT_THAT(run.times(), IsEmpty());
}

TEST(RunPoses, AreMissingForTheLastScansIfTheFileIsShorter) {
  const RunPoses run = pair_poses(straight_path(2), named_scans({"a", "b", "c", "d"}), {});

  EXPECT_THAT(x_of(run), ElementsAre(0, 1, testing::IsNan(), testing::IsNan()));
  EXPECT_EQ(run.scans[3].reason, "the file contains only 2 poses");
  EXPECT_THAT(run.notes,
              ElementsAre("contains 2 poses for 4 scans (the last scans are segmented alone)",
                          "2 scans without a pose: the file contains only 2 poses (segmented "
                          "alone)"));
}

TEST(RunPoses, AreIgnoredAfterTheLastScan) {
  const RunPoses run = pair_poses(straight_path(4), named_scans({"a", "b"}), {});

  EXPECT_THAT(x_of(run), ElementsAre(0, 1));
  EXPECT_THAT(run.notes, ElementsAre("contains 4 poses for 2 scans (the last poses are not used)"));
}

TEST(RunPoses, BelongToTheNumbersOfScansIfTheirCountsDiffer) {
  const std::vector<ScanInput> without_scan_1 = named_scans({"000000", "000002", "000003"});

  const RunPoses part = pair_poses(straight_path(200), numbered_scans(3, 100), {});
  const RunPoses gap = pair_poses(straight_path(4), without_scan_1, {});
  const RunPoses from_one = pair_poses(straight_path(3), numbered_scans(3, 1), {});

  EXPECT_THAT(x_of(part), ElementsAre(100, 101, 102));
  EXPECT_THAT(part.notes,
              ElementsAre("contains 200 poses for 3 scans (scans are paired with poses by the "
                          "numbers in their names)"));
  EXPECT_THAT(x_of(gap), ElementsAre(0, 2, 3));
  EXPECT_THAT(x_of(from_one), ElementsAre(0, 1, 2));
}

TEST(RunPoses, ThatAreInvalidAreMissingWithTheirLine) {
  io::PoseFile file = straight_path(3);
  file.poses[1].pose.reset();
  file.poses[1].fault = io::PoseFault::not_finite;

  const RunPoses run = pair_poses(file, numbered_scans(3), {});

  EXPECT_FALSE(run.scans[1].pose);
  EXPECT_EQ(run.scans[1].reason, "the pose of line 2 is not finite");
  EXPECT_THAT(run.notes, ElementsAre("1 scan without a pose: the pose of line 2 is not finite "
                                     "(segmented alone)"));
}

TEST(RunPoses, AreInterpolatedAtTheTimesOfScans) {
  io::PoseFile file = straight_path(3, true);
  file.poses[1].pose->rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};

  const RunPoses run =
      pair_poses(file, numbered_scans(3), std::vector<double>{100.05, 100.1, 100.175});

  EXPECT_THAT(x_of(run), testing::Pointwise(testing::DoubleNear(1e-9), {0.5, 1.0, 1.75}));
  EXPECT_NEAR(std::atan2(run.scans[0].pose->rotation[3], run.scans[0].pose->rotation[0]),
              std::numbers::pi / 4, 1e-9);
  EXPECT_THAT(run.times(), ElementsAre(100.05, 100.1, 100.175));
  EXPECT_THAT(run.notes, IsEmpty());
}

TEST(RunPoses, AreNeverExtrapolated) {
  const RunPoses run = pair_poses(straight_path(3, true), numbered_scans(4),
                                  std::vector<double>{99.9, 99.9995, 100.2005, 100.3});

  EXPECT_THAT(x_of(run), ElementsAre(testing::IsNan(), 0, 2, testing::IsNan()));
  EXPECT_EQ(run.scans[0].reason, "its time is before the first pose");
  EXPECT_EQ(run.scans[3].reason, "its time is after the last pose");
}

TEST(RunPoses, AreNotInterpolatedAcrossGaps) {
  io::PoseFile file = straight_path(5, true);
  file.poses.erase(file.poses.begin() + 1);  // 0.2 s without a pose
  file.poses[2].pose.reset();                // and a bad one at 100.3
  file.poses[2].fault = io::PoseFault::not_a_rotation;

  const RunPoses run =
      pair_poses(file, numbered_scans(4), std::vector<double>{100.05, 100.2, 100.3, 100.4});

  EXPECT_THAT(x_of(run), ElementsAre(testing::IsNan(), 2, testing::IsNan(), 4));
  EXPECT_EQ(run.scans[0].reason,
            "the poses before and after it are 0.20 s apart (expected at most 0.15 s)");
  EXPECT_EQ(run.scans[2].reason, "the pose of line 4 has no valid rotation");
}

TEST(RunPoses, MayHaveTimesInAnyOrder) {
  io::PoseFile file = straight_path(3, true);
  std::swap(file.poses[0], file.poses[2]);

  const RunPoses run = pair_poses(file, numbered_scans(3), std::vector<double>{100, 100.1, 100.15});

  EXPECT_THAT(x_of(run), testing::Pointwise(testing::DoubleNear(1e-9), {0.0, 1.0, 1.5}));
  EXPECT_THAT(run.notes, ElementsAre(HasSubstr("not in the order of their times")));
}

TEST(RunPoses, OfAnotherClockAreReported) {
  const RunPoses run =
      pair_poses(straight_path(2, true), numbered_scans(2), std::vector<double>{0, 0.1});

  EXPECT_THAT(x_of(run), ElementsAre(testing::IsNan(), testing::IsNan()));
  EXPECT_THAT(run.notes, testing::Contains(
                             HasSubstr("the times of the poses, 100.000 to 100.100 s, do not match "
                                       "the times of the scans, 0.000 to 0.100 s")));
}

TEST(RunPoses, WithTimesBelongToScansWithoutTimesInTheirOrder) {
  const RunPoses run = pair_poses(straight_path(2, true), numbered_scans(2), {});

  EXPECT_THAT(x_of(run), ElementsAre(0, 1));
  EXPECT_THAT(run.times(), ElementsAre(100, 100.1));
}

TEST(RunPoses, ScansWithoutATimeHaveNone) {
  const RunPoses run =
      pair_poses(straight_path(3, true), numbered_scans(3), std::vector<double>{100, std::nan("")});

  EXPECT_THAT(x_of(run), ElementsAre(0, testing::IsNan(), testing::IsNan()));
  EXPECT_EQ(run.scans[1].reason, "its time is unknown");
  EXPECT_THAT(run.notes,
              testing::Contains("the run contains 2 times for 3 scans (scans are paired with times "
                                "by the numbers in their names)"));
}

constexpr const char* calibration = "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n";

TEST(RunPoses, OfACameraAreConvertedWithTheCalibrationOfTheRun) {
  const io::TemporaryFolder run;
  const io::TemporaryFolder elsewhere;
  fs::create_directory(run / "velodyne");
  io::put_file(elsewhere / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n");

  const auto position = [&](const fs::path& folder) {
    const RunPoses poses = read_run_poses(folder, numbered_scans(1), elsewhere / "poses.txt");
    return poses.scans[0].pose->position;
  };
  EXPECT_THAT(position(run.path()), ElementsAre(0, 0, 5));
  io::put_file(run / "calib.txt", calibration);
  EXPECT_THAT(position(run.path()), ElementsAre(5, 0, 0));
  EXPECT_THAT(position(run / "velodyne"), ElementsAre(5, 0, 0));
  io::put_file(elsewhere / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(position(run.path()), ElementsAre(0, 0, 5));
}

TEST(RunPoses, WithTimesUseTheTimesOfTheRun) {
  const io::TemporaryFolder run;
  io::put_file(run / "times.txt", "10\n10.1\n");
  io::put_file(run / "calib.txt", "not used for TUM\n");
  io::put_file(run / "poses.tum", "10 1 0 0 0 0 0 1\n10.05 2 0 0 0 0 0 1\n10.1 3 0 0 0 0 0 1\n");

  const RunPoses poses = read_run_poses(run.path(), numbered_scans(2), run / "poses.tum");

  EXPECT_THAT(x_of(poses), ElementsAre(1, 3));
  EXPECT_TRUE(poses.calibration.empty());
}

TEST(RunPoses, ErrorsOfFilesAreOneLine) {
  const io::TemporaryFolder run;
  const auto complaint = [&] {
    try {
      read_run_poses(run.path(), numbered_scans(1), run / "poses.txt");
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(complaint(), HasSubstr("poses.txt: cannot be opened"));
  io::put_file(run / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n");
  io::put_file(run / "times.txt", "noon\n");
  EXPECT_THAT(complaint(), HasSubstr("times.txt: line 1: 'noon' is not a time"));
  io::put_file(run / "calib.txt", "P0: 1\n");
  EXPECT_THAT(complaint(), HasSubstr("calib.txt: contains no line 'Tr:'"));
}

TEST(RunPoses, NotesBeginWithTheFile) {
  const io::TemporaryFolder run;
  io::put_file(run / "poses.txt", "1 0 0 0 0 1 0 0 0 0 1 5\n");

  const RunPoses poses = read_run_poses(run.path(), numbered_scans(2), run / "poses.txt");

  ASSERT_EQ(poses.notes.size(), 2U);
  EXPECT_THAT(poses.notes[0], testing::StartsWith((run / "poses.txt: contains 1 pose").string()));
}

}  // namespace
}  // namespace flagstone::app
