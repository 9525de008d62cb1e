// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/output_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class OutputPlanTest : public testing::Test {
 protected:
  fs::path put(const std::string& name) const {
    fs::create_directories((folder_ / name).parent_path());
    io::put_file(folder_ / name, "precious");
    return folder_ / name;
  }

  /// The error message of the plan; empty if there is none.
  [[nodiscard]] std::string complaint() const {
    try {
      plan_.check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return {};
  }

  io::TemporaryFolder folder_;
  OutputPlan plan_;
};

TEST_F(OutputPlanTest, AcceptsSeparateFiles) {
  plan_.reads(put("scan.bin"));
  plan_.reads({});
  plan_.writes(folder_ / "scan.label");
  plan_.writes(put("scan.heights.npy"));  // from an earlier run
  plan_.writes({});

  EXPECT_EQ(complaint(), "");
}

TEST_F(OutputPlanTest, RejectsAnOutputThatIsAnInputAndNamesBoth) {
  plan_.reads(put("scan.bin"));
  plan_.writes(folder_ / "nowhere/../scan.bin");
  fs::create_directory(folder_ / "nowhere");

  EXPECT_THAT(complaint(),
              AllOf(StartsWith((folder_ / "nowhere/../scan.bin").string() + ": "),
                    HasSubstr("overwrite the input " + (folder_ / "scan.bin").string() + " "),
                    Not(HasSubstr("\n"))));
}

TEST_F(OutputPlanTest, RejectsLinksToAnInput) {
  const fs::path scan = put("scan.bin");
  fs::create_hard_link(scan, folder_ / "hard");
  fs::create_symlink(scan, folder_ / "soft");
  fs::create_directory_symlink(folder_.path(), folder_ / "folder");
  for (const char* name : {"hard", "soft", "folder/scan.bin"}) {
    OutputPlan plan;
    plan.reads(scan);
    plan.writes(folder_ / name);
    EXPECT_THROW(plan.check(), std::invalid_argument) << name;
  }
}

TEST_F(OutputPlanTest, RejectsAnInputThatIsALinkToTheOutput) {
  fs::create_symlink(put("scan.bin"), folder_ / "link.bin");
  plan_.reads(folder_ / "link.bin");
  plan_.writes(folder_ / "scan.bin");

  EXPECT_THAT(complaint(), HasSubstr("overwrite the input " + (folder_ / "link.bin").string()));
}

TEST_F(OutputPlanTest, EveryFileOfADatasetIsAnInputExceptEarlierResults) {
  const fs::path data = folder_ / "data";
  for (const char* name : {"velodyne/0.bin", "labels/0.label", "poses.txt", "scene.json"}) {
    put(std::string("data/") + name);
    OutputPlan plan;
    plan.reads_dataset(data);
    plan.writes(data / name);
    EXPECT_THROW(plan.check(), std::invalid_argument) << name;
  }
  for (const char* name : {"results.json", "results.csv", "report.html", "0.png"}) {
    put(std::string("data/") + name);
    OutputPlan plan;
    plan.reads_dataset(data);
    plan.writes(data / name);
    EXPECT_NO_THROW(plan.check()) << name;
  }
}

TEST_F(OutputPlanTest, FollowsLinksInADataset) {
  const fs::path label = put("elsewhere/00/labels/0.label");
  fs::create_directory(folder_ / "data");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "data/sequences");
  plan_.reads_dataset(folder_ / "data");
  plan_.writes(label);

  EXPECT_THAT(complaint(), HasSubstr("data/sequences/00/labels/0.label"));
}

TEST_F(OutputPlanTest, RejectsTwoOutputsInOneFile) {
  plan_.writes(folder_ / "out/a.npy");
  plan_.writes(folder_ / "b.npy");
  plan_.writes(folder_ / "out/../out/a.npy");

  EXPECT_THAT(complaint(), AllOf(HasSubstr("overwrite the output "), HasSubstr("of the same run")));
}

TEST_F(OutputPlanTest, AcceptsOutputsThatAreHardLinksOfEachOther) {
  fs::create_hard_link(put("a.label"), folder_ / "b.label");
  plan_.writes(folder_ / "a.label");
  plan_.writes(folder_ / "b.label");

  EXPECT_EQ(complaint(), "");
}

TEST_F(OutputPlanTest, EscapesLineBreaksInNames) {
  const fs::path scan = put("two\nlines.bin");
  plan_.reads(scan);
  plan_.writes(scan);

  EXPECT_THAT(complaint(), AllOf(HasSubstr("two\\x0alines.bin"), Not(HasSubstr("\n"))));
}

}  // namespace
}  // namespace flagstone::app
