// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/found_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::eval {
namespace {

namespace fs = std::filesystem;

class FoundFiles : public testing::Test {
 protected:
  void put(const std::string& name) const {
    fs::create_directories((folder_ / name).parent_path());
    io::put_file(folder_ / name, "");
  }

  static LabelledScan scan(const std::string& name, bool is_of_only_sequence = false) {
    LabelledScan scan;
    scan.name = name;
    scan.is_of_only_sequence = is_of_only_sequence;
    return scan;
  }

  /// Path of a file below the directory.
  [[nodiscard]] std::string below(const fs::path& path) const {
    return path.lexically_relative(folder_.path()).string();
  }

  io::TemporaryFolder folder_;
};

TEST_F(FoundFiles, LabelsOfAMappedRunHaveTheCodesOfFlagstone) {
  put("run.json");
  put("labels/000120.label");

  const LabelFile file = label_file(folder_.path(), scan("000120"));

  EXPECT_EQ(below(file.path), "labels/000120.label");
  EXPECT_TRUE(file.is_mapped);
  EXPECT_TRUE(file.heights.empty());
}

TEST_F(FoundFiles, HeightsOfAMappedRunAreOptional) {
  put("run.json");
  put("heights/000000.heights.npy");

  EXPECT_EQ(below(label_file(folder_.path(), scan("000120")).heights),
            "heights/000120.heights.npy");
}

TEST_F(FoundFiles, ADirectoryCanHaveAMappedRunPerSequence) {
  put("05/run.json");

  EXPECT_EQ(below(label_file(folder_.path(), scan("05/000120")).path), "05/labels/000120.label");
  EXPECT_EQ(below(moving_file(folder_.path(), scan("05/000120"))), "05/moving/000120.moving.npy");
}

TEST_F(FoundFiles, AMappedRunFitsADatasetOfOneSequenceOnly) {
  put("run.json");
  put("moving/000120.moving.npy");

  EXPECT_EQ(below(label_file(folder_.path(), scan("05/000120", true)).path), "labels/000120.label");
  EXPECT_EQ(below(moving_file(folder_.path(), scan("05/000120", true))),
            "moving/000120.moving.npy");
  EXPECT_FALSE(label_file(folder_.path(), scan("05/000120", false)).is_mapped);
  EXPECT_EQ(below(moving_file(folder_.path(), scan("05/000120", false))), "05/000120.npy");
}

TEST_F(FoundFiles, MovingPointsOfOtherProgramsHaveSeveralLayouts) {
  for (const std::string name :
       {"05/000120.npy", "05/moving/000120.moving.npy", "05/000120.moving.npy", "05/000120.label",
        "sequences/05/predictions/000120.label"}) {
    put(name);
    EXPECT_EQ(below(moving_file(folder_.path(), scan("05/000120"))), name);
    fs::remove(folder_ / name);
  }
}

TEST_F(FoundFiles, AMissingFileIsTheExpectedOne) {
  EXPECT_EQ(below(moving_file(folder_.path(), scan("000120"))), "000120.npy");
  put("run.json");
  EXPECT_EQ(below(moving_file(folder_.path(), scan("000120"))), "moving/000120.moving.npy");
}

}  // namespace
}  // namespace flagstone::eval
