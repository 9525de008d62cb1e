// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/scan_inputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Name of the file and stem of its outputs.
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

TEST(ScanInputs, StemsLoseTheExtensionsOfScans) {
  EXPECT_EQ(without_scan_extension("000000.bin"), "000000");
  EXPECT_EQ(without_scan_extension("scene-k00.pcd.bin"), "scene-k00");
  EXPECT_EQ(without_scan_extension("scene-k00.PCD.BIN"), "scene-k00");
  EXPECT_EQ(without_scan_extension("a/scan.v2.ply"), "a/scan.v2");
  EXPECT_EQ(without_scan_extension("a.pcd.ply"), "a.pcd");
  EXPECT_EQ(without_scan_extension("scan"), "scan");
}

TEST(ScanInputs, FilesKeepTheOrderTheyAreNamedIn) {
  EXPECT_THAT(list_scans({"there/b.bin", "a.pcd"}),
              ElementsAre(is_scan("there/b.bin", "b"), is_scan("a.pcd", "a")));
}

TEST(ScanInputs, FoldersAreWalkedInAlphabeticalOrderAndKeepTheirInnerPaths) {
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

TEST(ScanInputs, AFolderWithoutScansIsRefusedWithWhatScansEndIn) {
  const io::TemporaryFolder folder;
  put(folder / "notes.txt");

  EXPECT_THAT(
      complaint({folder.path().string()}),
      AllOf(HasSubstr(folder.path().string()), HasSubstr(".pcd.bin"), Not(HasSubstr("\n"))));
}

TEST(ScanInputs, ScansThatWouldWriteToTheSameFileAreRefusedNamingBoth) {
  EXPECT_THAT(complaint({"00/000000.bin", "01/000000.bin"}),
              AllOf(HasSubstr("00/000000.bin"), HasSubstr("01/000000.bin")));
  EXPECT_THAT(complaint({"a.bin", "a.ply"}), HasSubstr("would both write to a.*"));
  EXPECT_THAT(complaint({"a.bin", "./a.bin"}), HasSubstr("would both write to a.*"));
}

TEST(ScanInputs, AFileThatIsNotThereIsLeftToTheReader) {
  EXPECT_THAT(list_scans({"nowhere.bin"}), ElementsAre(is_scan("nowhere.bin", "nowhere")));
}

}  // namespace
}  // namespace flagstone::cli
