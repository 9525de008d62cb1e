// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/labelled_scans.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

class SweepCommand : public testing::Test {
 protected:
  SweepCommand() {
    put_labelled(folder_ / "kitti", "a", small_scan(3000, 1));
    put_labelled(folder_ / "kitti", "b", small_scan(3000, 2));
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// `flagstone sweep DATASET --json sweep.json` and more.
  [[nodiscard]] Outcome sweep(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"sweep", path("kitti"), "--json", path("sweep.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// The results file; expects success.
  [[nodiscard]] json results(const std::vector<std::string>& more = {}) const {
    const Outcome outcome = sweep(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json_of(folder_ / "sweep.json");
  }

  io::TemporaryFolder folder_;
};

TEST_F(SweepCommand, ReproducesFigure5ByDefault) {
  const json found = results();

  EXPECT_EQ(found["method"], "r_gpf+u");
  EXPECT_EQ(found["keys"], json::array({"bins", "uprightness.angle"}));
  EXPECT_THAT(found["cells"], SizeIs(36));
  EXPECT_EQ(found["cells"][7]["values"], json::array({"15x54", "15"}));
}

TEST_F(SweepCommand, EveryPointHasTheScoreOfEval) {
  const json found =
      results({"--method", "gpf", "--param", "segments=1,4", "--param", "seed_height=0.1,0.4"});

  EXPECT_EQ(found["protocol"], "patchwork");
  EXPECT_EQ(found["scans"], 2);
  ASSERT_THAT(found["cells"], SizeIs(4));
  const json& cell = found["cells"][2];
  EXPECT_EQ(cell["values"], json::array({"4", "0.1"}));
  const Outcome outcome = run({"eval", path("kitti"), "--methods", "gpf", "--set", "gpf.segments=4",
                               "--set", "gpf.seed_height=0.1", "--json", path("eval.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const json evaluated = json_of(folder_ / "eval.json")["methods"][0];
  for (const char* figure : {"precision", "recall", "f1"}) {
    EXPECT_EQ(cell[figure], evaluated[figure]) << figure;
  }
}

TEST_F(SweepCommand, PrintsARowPerPointAndTheBest) {
  const Outcome outcome = sweep({"--method", "patchwork", "--param", "distance_margin=0.05,0.2"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("Method patchwork, protocol patchwork, 2 scans of kitti"));
  EXPECT_THAT(outcome.out, ContainsRegex("\n +distance_margin +precision +std +recall"));
  EXPECT_THAT(outcome.out, ContainsRegex("\n +0.05 +[0-9.]+ +[0-9.]+ "));
  EXPECT_THAT(outcome.out, ContainsRegex("\n +0.2 +[0-9.]+ +[0-9.]+ "));
  EXPECT_THAT(outcome.out, ContainsRegex("\nBest F1: [0-9.]+ % at distance_margin = 0"));
}

TEST_F(SweepCommand, WritesCsvAndASelfContainedHtmlReport) {
  const Outcome outcome = sweep({"--method", "patchwork", "--param", "seed_count=5,10,20", "--csv",
                                 path("new/sweep.csv"), "--html", path("new/sweep.html")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(lines_of(io::contents_of(folder_ / "new/sweep.csv")), SizeIs(1 + 3));
  const std::string html = io::contents_of(folder_ / "new/sweep.html");
  EXPECT_TRUE(html.starts_with("<!doctype html>"));
  EXPECT_NE(html.find("seed_count for patchwork"), std::string::npos);
  const std::regex loads(R"((src|href)\s*=\s*["']?\s*(https?:|//)|@import|url\()");
  EXPECT_FALSE(std::regex_search(html, loads));
  EXPECT_FALSE(fs::exists(folder_ / "sweep.json.checkpoint"));
}

TEST_F(SweepCommand, ResultsDoNotDependOnTheNumberOfThreads) {
  const std::vector<std::string> over = {"--param", "bins=10x36,30x108"};
  const json one = results({over[0], over[1], "--threads", "1"});
  const json two = results({over[0], over[1], "--threads", "2"});

  EXPECT_EQ(one["cells"], two["cells"]);
}

TEST_F(SweepCommand, ReportsAnUnreadableScanOnOneLineAndContinues) {
  io::put_file(folder_ / "kitti/velodyne/b.bin", "no scan");

  const Outcome outcome = sweep({"--param", "bins=10x36"});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("b.bin"));
  EXPECT_EQ(json_of(folder_ / "sweep.json")["scans"], 1);
}

TEST_F(SweepCommand, ReportsUsageErrorsOnOneLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> misuses = {
      {{"--param", "seed_count"}, "KEY=VALUE"},
      {{"--param", "seed_cuont=3"}, "no setting 'seed_cuont'"},
      {{"--param", "bins=many"}, "RINGSxSECTORS"},
      {{"--param", "bins=10x4000"}, "sectors = 4000"},
      {{"--param", "distance_margin=-1"}, "distance_margin = -1"},
      {{"--method", "gpf", "--param", "bins=10x36"}, "(expected RINGSxSECTORS"},
      {{"--method", "gpf"}, "no setting 'uprightness'"},  // Fig. 5 needs zones
      {{"--method", "magic"}, "magic"},
      {{"--param", "a=1", "--param", "b=1", "--param", "c=1"}, "once or twice"},
      {{"--param", "seed_count=5", "--param", "seed_count=6"}, "seed_count is given twice"},
  };
  for (const auto& [arguments, said] : misuses) {
    const Outcome outcome = sweep(arguments);

    EXPECT_EQ(outcome.exit_code, 2) << arguments[1];
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, is_one_line_with(said));
    EXPECT_FALSE(fs::exists(folder_ / "sweep.json"));
  }
}

}  // namespace
}  // namespace flagstone::cli
