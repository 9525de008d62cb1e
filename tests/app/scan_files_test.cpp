// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/npy.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Matches file and output stem.
auto is_scan(const fs::path& file, const fs::path& stem) {
  return AllOf(testing::Field("file", &ScanInput::file, file),
               testing::Field("output_stem", &ScanInput::output_stem, stem));
}

void put(const fs::path& file) {
  fs::create_directories(file.parent_path());
  io::put_file(file, "");
}

std::string complaint(const std::vector<std::string>& paths) {
  try {
    list_scans(paths);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(ScanFiles, StemsHaveNoScanExtension) {
  EXPECT_EQ(without_scan_extension("000000.bin"), "000000");
  EXPECT_EQ(without_scan_extension("scene-k00.pcd.bin"), "scene-k00");
  EXPECT_EQ(without_scan_extension("scene-k00.PCD.BIN"), "scene-k00");
  EXPECT_EQ(without_scan_extension("a/scan.v2.ply"), "a/scan.v2");
  EXPECT_EQ(without_scan_extension("a.pcd.ply"), "a.pcd");
  EXPECT_EQ(without_scan_extension("scan"), "scan");
}

TEST(ScanFiles, NamedFilesKeepTheirOrder) {
  EXPECT_THAT(list_scans({"there/b.bin", "a.pcd"}),
              ElementsAre(is_scan("there/b.bin", "b"), is_scan("a.pcd", "a")));
}

TEST(ScanFiles, DirectoriesAreSearchedInAlphabeticalOrderAndKeepInnerPaths) {
  const io::TemporaryFolder folder;
  for (const char* name : {"c.npy", "00/velodyne/000001.bin", "00/velodyne/000000.bin",
                           "00/labels/000000.label", "k_lidarseg.bin", "b.pcd.bin", "notes.txt"}) {
    put(folder / name);
  }

  EXPECT_THAT(list_scans({folder.path().string()}),
              ElementsAre(is_scan(folder / "00/velodyne/000000.bin", "00/velodyne/000000"),
                          is_scan(folder / "00/velodyne/000001.bin", "00/velodyne/000001"),
                          is_scan(folder / "b.pcd.bin", "b"), is_scan(folder / "c.npy", "c")));
}

TEST(ScanFiles, RejectsADirectoryWithoutScansAndNamesTheExtensions) {
  const io::TemporaryFolder folder;
  put(folder / "notes.txt");

  EXPECT_THAT(
      complaint({folder.path().string()}),
      AllOf(HasSubstr(folder.path().string()), HasSubstr(".pcd.bin"), Not(HasSubstr("\n"))));
}

TEST(ScanFiles, RejectsScansWithTheSameOutputAndNamesBoth) {
  EXPECT_THAT(complaint({"00/000000.bin", "01/000000.bin"}),
              AllOf(HasSubstr("00/000000.bin"), HasSubstr("01/000000.bin")));
  EXPECT_THAT(complaint({"a.bin", "a.ply"}), HasSubstr("would both write to a.*"));
  EXPECT_THAT(complaint({"a.bin", "./a.bin"}), HasSubstr("would both write to a.*"));
}

TEST(ScanFiles, DoesNotCheckThatNamedFilesExist) {
  EXPECT_THAT(list_scans({"nowhere.bin"}), ElementsAre(is_scan("nowhere.bin", "nowhere")));
}

/// The names of the scans found in a directory. Appends messages to `messages`.
std::vector<std::string> names_in(const fs::path& folder, std::vector<std::string>& messages) {
  std::vector<std::string> names;
  const RunCallbacks callbacks{
      .message = [&](const std::string& line) { messages.push_back(line); }};
  for (const ScanInput& scan : find_scans({folder.string()}, callbacks)) {
    names.push_back(scan.file.lexically_relative(folder).string());
  }
  return names;
}

TEST(ScanFiles, SkipsAndCountsTheOutputsOfSegment) {
  const io::TemporaryFolder folder;
  const auto put_array = [&](const char* name, std::vector<std::size_t> shape) {
    ASSERT_TRUE(io::write_npy_file(folder / name, std::vector<float>(8), shape).ok());
  };
  put(folder / "x.pcd");
  put(folder / "x.ground.pcd");
  put(folder / "x.nonground.pcd");
  put(folder / "y.pcd.bin");
  put(folder / "y.ground.pcd.bin");
  put(folder / "y.nonground.pcd.bin");
  put_array("x.heights.npy", {8});
  put_array("x.label.npy", {8});
  put_array("x.surface.npy", {2, 4});
  put(folder / "x.surface.json");

  std::vector<std::string> messages;
  EXPECT_THAT(names_in(folder.path(), messages), ElementsAre("x.pcd", "y.pcd.bin"));
  EXPECT_THAT(messages, ElementsAre(AllOf(HasSubstr(folder.path().string() + ": skipped 5 files"),
                                          Not(HasSubstr("\n")))));
}

TEST(ScanFiles, DoesNotSkipScansWithTheNamesOfOutputs) {
  const io::TemporaryFolder folder;
  put(folder / "x.pcd");
  put(folder / "x.ground.pcd");  // without x.nonground.pcd
  put(folder / "lone.ground.bin");
  put(folder / "lone.nonground.bin");  // without lone.bin
  ASSERT_TRUE(io::write_npy_file(folder / "x.heights.npy", std::vector<float>(8),
                                 std::vector<std::size_t>{2, 4})
                  .ok());  // not an array of heights
  ASSERT_TRUE(io::write_npy_file(folder / "x.surface.npy", std::vector<float>(8),
                                 std::vector<std::size_t>{2, 4})
                  .ok());  // without x.surface.json

  std::vector<std::string> messages;
  EXPECT_THAT(names_in(folder.path(), messages),
              ElementsAre("lone.ground.bin", "lone.nonground.bin", "x.ground.pcd", "x.heights.npy",
                          "x.pcd", "x.surface.npy"));
  EXPECT_THAT(messages, ElementsAre());
}

TEST(ScanFiles, NeverSkipsANamedFile) {
  const io::TemporaryFolder folder;
  for (const char* name : {"x.pcd", "x.ground.pcd", "x.nonground.pcd"}) put(folder / name);

  EXPECT_THAT(find_scans({(folder / "x.ground.pcd").string()}),
              ElementsAre(is_scan(folder / "x.ground.pcd", "x.ground")));
}

}  // namespace
}  // namespace flagstone::app
