// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "app/segment_scan.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;

const ScanInput scan = {.file = "data/00/000007.bin", .output_stem = "00/000007"};

TEST(ReferenceFile, FileIsTheReferenceItself) {
  EXPECT_EQ(reference_file("truth/000007.label", scan), "truth/000007.label");
}

TEST(ReferenceFile, InADirectoryThePathOfTheScanComesFirst) {
  const io::TemporaryFolder folder;
  fs::create_directories(folder / "00");
  io::put_file(folder / "00/000007.label", "");
  io::put_file(folder / "000007.label", "");

  EXPECT_EQ(reference_file(folder.path(), scan), folder / "00/000007.label");
}

TEST(ReferenceFile, InADirectoryTheNameOfTheScanIsFound) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "000007.label", "");

  EXPECT_EQ(reference_file(folder.path(), scan), folder / "000007.label");
}

TEST(ReferenceFile, InADirectoryTheLidarsegFileIsFound) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "000007_lidarseg.bin", "");

  EXPECT_EQ(reference_file(folder.path(), scan), folder / "000007_lidarseg.bin");
}

TEST(ReferenceFile, InADirectoryTheLabelArrayIsFound) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "000007.label.npy", "");

  EXPECT_EQ(reference_file(folder.path(), scan), folder / "000007.label.npy");
}

TEST(ReferenceFile, IsTheFirstCandidateIfNoneExists) {
  const io::TemporaryFolder folder;

  EXPECT_EQ(reference_file(folder.path(), scan), folder / "00/000007.label");
}

}  // namespace
}  // namespace flagstone::app
