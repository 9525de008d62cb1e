// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
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
using testing::HasSubstr;

constexpr int scans = 150;

/// A dataset, and an evaluation that takes long enough to be interrupted: GPF with many
/// iterations.
class EvalResume : public testing::Test {
 protected:
  EvalResume() { put_dataset("kitti", 1); }

  /// Three different scans under many names.
  void put_dataset(const std::string& name, std::uint32_t seed) const {
    const fs::path folder = folder_ / name;
    for (int i = 0; i < scans; ++i) {
      const std::string scan = std::to_string(1000 + i);
      if (i < 3) {
        put_labelled(folder, scan, small_scan(20000, seed + static_cast<std::uint32_t>(i)));
        continue;
      }
      const std::string other = std::to_string(1000 + i % 3);
      fs::create_hard_link(folder / ("velodyne/" + other + ".bin"),
                           folder / ("velodyne/" + scan + ".bin"));
      fs::create_hard_link(folder / ("labels/" + other + ".label"),
                           folder / ("labels/" + scan + ".label"));
    }
  }

  [[nodiscard]] std::vector<std::string> arguments(
      const std::string& results, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"eval",   (folder_ / "kitti").string(), "--methods", "gpf",
                                    "--set",  "gpf.iterations=60",          "--threads", "2",
                                    "--json", (folder_ / results).string()};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  [[nodiscard]] std::string checkpoint() const {
    return io::contents_of(folder_ / "results.json.checkpoint");
  }

  /// Number of scans in the checkpoint: one per line, after the first line.
  [[nodiscard]] std::ptrdiff_t scans_in_checkpoint() const {
    return std::max<std::ptrdiff_t>(std::ranges::count(checkpoint(), '\n') - 1, 0);
  }

  /// Interrupts the evaluation after a few scans.
  [[nodiscard]] Outcome interrupted() const {
    using namespace std::chrono_literals;
    CommandProcess command(arguments("results.json"));
    for (int wait = 0; wait < 60000 && scans_in_checkpoint() < 3; ++wait) {
      std::this_thread::sleep_for(1ms);
    }
    command.send(SIGINT);
    return command.finish();
  }

  io::TemporaryFolder folder_;
};

TEST_F(EvalResume, ResumedRunHasTheResultsOfAnUninterruptedRun) {
  const Outcome undisturbed = run(arguments("undisturbed.json"));
  ASSERT_EQ(undisturbed.exit_code, 0) << undisturbed.err;

  const Outcome stopped = interrupted();

  EXPECT_EQ(stopped.exit_code, 1);
  const std::ptrdiff_t done = scans_in_checkpoint();
  EXPECT_GE(done, 3);
  EXPECT_LT(done, scans);
  EXPECT_THAT(stopped.err, is_one_line_with("interrupted: " + std::to_string(done) +
                                            " of 150 scans are done (run the same command with "
                                            "--resume for the rest)"));
  EXPECT_THAT(stopped.out, HasSubstr(std::to_string(done) + " scans of kitti"));
  EXPECT_FALSE(fs::exists(folder_ / "results.json"));

  const Outcome finished = run(arguments("results.json", {"--resume"}));

  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_FALSE(fs::exists(folder_ / "results.json.checkpoint"));
  EXPECT_EQ(without_times(json_of(folder_ / "results.json")),
            without_times(json_of(folder_ / "undisturbed.json")));
}

TEST_F(EvalResume, SkipsTheScansInTheCheckpoint) {
  ASSERT_EQ(interrupted().exit_code, 1);
  std::string kept = checkpoint();
  const std::size_t from = kept.find("\"ms\":");
  ASSERT_NE(from, std::string::npos);
  const std::size_t end = kept.find_first_of(",}", from);
  io::put_file(folder_ / "results.json.checkpoint",
               kept.replace(from, end - from, "\"ms\":98765.5"));

  const Outcome finished = run(arguments("results.json", {"--resume"}));

  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  const auto times = json_of(folder_ / "results.json")["methods"][0]["per_scan"];
  EXPECT_EQ(std::ranges::count_if(times,
                                  [](const auto& scan) { return scan["milliseconds"] == 98765.5; }),
            1);
}

TEST_F(EvalResume, RejectsAndKeepsTheCheckpointOfAnotherEvaluation) {
  put_dataset("other", 7);
  ASSERT_EQ(interrupted().exit_code, 1);
  const std::string kept = checkpoint();
  std::vector<std::string> other_dataset = arguments("results.json");
  other_dataset[1] = (folder_ / "other").string();

  for (std::vector<std::string> all :
       {arguments("results.json", {"--set", "gpf.iterations=61"}),
        arguments("results.json", {"--protocol", "patchwork++"}),
        arguments("results.json", {"--methods", "ransac"}),
        arguments("results.json", {"--columns", "4"}), other_dataset}) {
    all.emplace_back("--resume");
    const Outcome outcome = run(all);

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err,
                is_one_line_with("results.json.checkpoint: belongs to an evaluation with "
                                 "other datasets, methods, settings or protocol"));
    EXPECT_EQ(checkpoint() == kept, true);
  }
}

TEST_F(EvalResume, RequiresTheResultsFileOfTheInterruptedRun) {
  const Outcome outcome = run({"eval", (folder_ / "kitti").string(), "--resume"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, is_one_line_with("--resume: needs the results file"));
}

TEST_F(EvalResume, RunsNormallyWithoutACheckpoint) {
  const Outcome outcome = run(arguments("results.json", {"--every", "50", "--resume"}));

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json_of(folder_ / "results.json")["scans"], 3);
}

}  // namespace
}  // namespace flagstone::cli
