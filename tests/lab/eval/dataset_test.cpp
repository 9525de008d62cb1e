// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/dataset.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "files/io/temporary_folder.hpp"

namespace flagstone::eval {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Dataset : public testing::Test {
 protected:
  void put(const std::string& name) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << "x";
  }
  void put_pairs(const std::string& folder, const std::vector<std::string>& names) const {
    for (const std::string& name : names) {
      put(folder + "/velodyne/" + name + ".bin");
      put(folder + "/labels/" + name + ".label");
    }
  }
  [[nodiscard]] std::vector<std::string> names(const Selection& selection = {}) const {
    std::vector<LabelledScan> scans;
    const Status status = list_dataset(folder_.path(), selection, scans);
    EXPECT_TRUE(status.ok()) << status.message();
    std::vector<std::string> names;
    for (const LabelledScan& scan : scans) {
      EXPECT_TRUE(fs::exists(scan.points) && fs::exists(scan.labels)) << scan.name;
      names.push_back(scan.name);
    }
    return names;
  }
  [[nodiscard]] std::string error_of(const Selection& selection = {}) const {
    std::vector<LabelledScan> scans;
    return list_dataset(folder_.path(), selection, scans).message();
  }

  io::TemporaryFolder folder_;
};

TEST_F(Dataset, ListsASemanticKittiTreeSequenceBySequence) {
  put_pairs("sequences/05", {"000001", "000000"});
  put_pairs("sequences/00", {"000007"});
  put("sequences/11/velodyne/000000.bin");  // without labels, like the test sequences

  EXPECT_THAT(names(), ElementsAre("00/000007", "05/000000", "05/000001"));
}

TEST_F(Dataset, AcceptsTheDirectoryOfSequences) {
  put_pairs("05", {"000001", "000000"});
  put_pairs("00", {"000007"});

  EXPECT_THAT(names(), ElementsAre("00/000007", "05/000000", "05/000001"));
  EXPECT_THAT(names({.sequences = {"00"}}), ElementsAre("00/000007"));
}

TEST_F(Dataset, FindsTrueGroundHeightsNextToTheLabels) {
  put_pairs("sequences/00", {"000000", "000001"});
  put("sequences/00/ground/000001.ground.npy");
  std::vector<LabelledScan> scans;

  ASSERT_TRUE(list_dataset(folder_.path(), {}, scans).ok());

  EXPECT_THAT(scans[0].ground, fs::path());
  EXPECT_THAT(scans[1].ground, folder_ / "sequences/00/ground/000001.ground.npy");
}

TEST_F(Dataset, SelectsSequencesAndEveryNthScan) {
  put_pairs("sequences/05", {"000000", "000001", "000002", "000003", "000004"});
  put_pairs("sequences/10", {"000000", "000001"});
  put_pairs("sequences/00", {"000000"});

  EXPECT_THAT(names({.sequences = {"10", "05"}, .every = 2}),
              ElementsAre("10/000000", "05/000000", "05/000002", "05/000004"));
}

TEST_F(Dataset, ListsADirectoryWithVelodyneAndLabels) {
  put_pairs(".", {"b", "a"});
  put("velodyne/c.bin");  // without a label file

  EXPECT_THAT(names(), ElementsAre("a", "b"));
}

TEST_F(Dataset, ListsNuScenesFilesInOneDirectory) {
  for (const std::string scan : {"k4", "k0"}) {
    put(scan + ".pcd.bin");
    put(scan + "_lidarseg.bin");
  }
  put("k8.pcd.bin");

  EXPECT_THAT(names(), ElementsAre("k0", "k4"));
}

TEST_F(Dataset, RejectsADirectoryThatIsNotADataset) {
  EXPECT_THAT(error_of(), HasSubstr("sequences/NN/velodyne"));
  put("velodyne/a.bin");
  EXPECT_THAT(error_of(), HasSubstr("labels/"));
  EXPECT_THAT(error_of({.sequences = {"05"}}), HasSubstr("05"));
}

TEST_F(Dataset, RejectsASelectedSequenceWithoutLabels) {
  put("sequences/11/velodyne/000000.bin");
  EXPECT_THAT(error_of(), HasSubstr("labels"));
  EXPECT_THAT(error_of({.sequences = {"11"}}), HasSubstr("11"));
  EXPECT_THAT(error_of({.sequences = {"99"}}), HasSubstr("99"));
}

}  // namespace
}  // namespace flagstone::eval
