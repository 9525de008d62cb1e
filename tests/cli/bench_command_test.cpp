// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;

/// The stages of surface, the default method.
const std::vector<std::string> stages = {"bin",   "group", "gather", "seed",    "moments",
                                         "solve", "join",  "refine", "measure", "label"};

/// A worker like bench/external_worker.py that supports only patchwork of pypatchworkpp. Every scan
/// takes 5 ms and has `ground` ground points. `before_answer` runs before each answer.
void put_fake_worker(const std::filesystem::path& file, const std::string& ground,
                     const std::string& before_answer = ":") {
  io::put_file(file, R"([ "$1" = pypatchworkpp-patchwork ] || { echo "ImportError: no $1"; exit 1; }
echo ready
runs=0
while read -r word number; do
  case $word in
    scan) dd bs=16 count="$number" iflag=fullblock of=/dev/null 2> /dev/null ;;
    run) runs=$((runs + 1)); )" +
                         before_answer + "; echo 5000000 " + ground + R"( ;;
  esac
done
)");
}

/// `flagstone bench --json` with a fake worker.
std::vector<std::string> with_worker(const std::filesystem::path& scans,
                                     const std::filesystem::path& worker) {
  return {"bench",    scans.string(), "--json",           "--compare",
          "--python", "sh",           "--compare-worker", worker.string()};
}

TEST(Bench, JsonHasTheTimesOfSegmentBaselineAndEveryStage) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scans/1.bin", small_scan(1000, 1));
  put_scan(folder / "scans/2.bin", small_scan(3000, 2));

  const Outcome outcome =
      run({"bench", (folder / "scans").string(), "--rounds", "3", "--json", "--isa", "scalar"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const json bench = json::parse(outcome.out);
  EXPECT_EQ(bench["method"], "surface");
  for (const char* what : {"segment", "floor"}) {
    EXPECT_GT(bench[what]["median_ms"].get<double>(), 0);
    EXPECT_GE(bench[what]["p99_ms"].get<double>(), bench[what]["median_ms"].get<double>());
  }
  EXPECT_GT(bench["ratio_to_floor"].get<double>(), 1);
  EXPECT_EQ(bench["stages"].size(), stages.size());
  for (const std::string& stage : stages) {
    for (const char* figure : {"median_ms", "p99_ms", "ratio"}) {
      EXPECT_TRUE(bench["stages"][stage][figure].is_number()) << stage << " " << figure;
    }
  }
  EXPECT_EQ(bench["external_tools"], json::object());
  EXPECT_EQ(bench["target"], "scalar");
  EXPECT_EQ(bench["allocations"], 0);
  EXPECT_GT(bench["bytes_held"].get<double>(), 3000);
  EXPECT_EQ(bench["points"], json::array({1000, 3000}));
  EXPECT_EQ(bench["rounds"], 3);
}

TEST(Bench, TimesPatchworkWithItsSettingsAndStages) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  const std::string scan = (folder / "scan.bin").string();
  const auto ground_with = [&](const std::string& setting) {
    const Outcome outcome =
        run({"bench", scan, "--method", "patchwork", "--set", setting, "--rounds", "1", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out)["segment"]["ground"].get<double>();
  };

  const Outcome outcome = run({"bench", scan, "--method", "patchwork", "--rounds", "2"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::StartsWith("Patchwork with "));
  for (const char* stage : {"bin", "moments", "solve", "label"}) {
    EXPECT_THAT(outcome.out, ContainsRegex(std::string("\n") + stage + " "));
  }
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("\nrefine ")));
  EXPECT_GT(ground_with("distance_margin=1"), ground_with("distance_margin=0.1"));
}

TEST(Bench, PrintsATableOfCandidatesAndATableOfStages) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");

  const Outcome outcome = run({"bench", (folder / "scan.bin").string(), "--rounds", "2"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1 scan of 4000 points (mean) in rotation, 2 rounds"));
  for (const char* row : {"segment ", "read-only baseline", "segment, scalar build"}) {
    EXPECT_THAT(outcome.out, ContainsRegex(std::string("\n") + row));
  }
  for (const std::string& stage : stages) {
    EXPECT_THAT(outcome.out, ContainsRegex("\n" + stage + " "));
  }
}

TEST(Bench, ReportsAnUntimeableScanOnOneLine) {
  const io::TemporaryFolder folder;
  put_scan(folder / "good.bin");
  io::put_file(folder / "cut.bin", "12345");
  io::put_file(folder / "empty.bin", "");

  const Outcome outcome =
      run({"bench", (folder / "cut.bin").string(), (folder / "empty.bin").string(),
           (folder / "good.bin").string(), "--rounds", "1", "--json"});

  EXPECT_EQ(outcome.exit_code, 1);
  ASSERT_EQ(lines_of(outcome.err).size(), 2U);
  EXPECT_THAT(lines_of(outcome.err)[0], HasSubstr("cut.bin: byte"));
  EXPECT_THAT(lines_of(outcome.err)[1], HasSubstr("empty.bin: has no points"));
  EXPECT_EQ(json::parse(outcome.out)["points"], json::array({4000}));
}

TEST(Bench, PrintsOnlyErrorsWithoutAScanToTime) {
  const io::TemporaryFolder folder;

  const Outcome outcome = run({"bench", (folder / "missing.bin").string(), "--json"});

  EXPECT_EQ(outcome.exit_code, 1);
  const json printed = json::parse(outcome.out);
  EXPECT_EQ(printed.size(), 1U);
  ASSERT_EQ(printed["errors"].size(), 1U);
  EXPECT_EQ(printed["errors"][0]["file"], (folder / "missing.bin").string());
  EXPECT_THAT(outcome.err, is_one_line_with("missing.bin"));
}

TEST(Bench, RejectsATrackedHeightWithSeveralThreads) {
  const io::TemporaryFolder folder;
  put_scan(folder / "1.bin", small_scan(1000, 1));

  const Outcome outcome =
      run({"bench", (folder / "1.bin").string(), "--sensor-height", "track", "--threads", "5"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, is_one_line_with("--threads 5"));
}

TEST(Bench, UsesTheClockOfAnExternalToolAndNamesMissingTools) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scans/1.bin", small_scan(1000, 1));
  put_scan(folder / "scans/2.bin", small_scan(3000, 2));
  put_fake_worker(folder / "worker.sh", "500");
  std::vector<std::string> arguments = with_worker(folder / "scans", folder / "worker.sh");
  arguments.insert(arguments.end(), {"--rounds", "1"});

  const Outcome outcome = run(arguments);

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json peers = json::parse(outcome.out)["external_tools"];
  const json& peer = peers["pypatchworkpp-patchwork"];
  EXPECT_EQ(peer["median_ms"], 5);
  EXPECT_EQ(peer["p99_ms"], 5);
  EXPECT_EQ(peer["ground"], 0.25);
  EXPECT_EQ(peer["samples"], 2);
  EXPECT_GT(peer["ratio"].get<double>(), 0);
  EXPECT_EQ(peers["open3d-ransac"], json({{"left_out", "ImportError: no open3d-ransac"}}));
  EXPECT_TRUE(peers.contains("pypatchworkpp-patchworkpp"));
  EXPECT_TRUE(peers.contains("pcl-ransac"));
}

TEST(Bench, ContinuesWithoutAnExternalToolThatFails) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  put_fake_worker(folder / "worker.sh", "1", "[ $runs -lt 3 ] || exit");
  std::vector<std::string> arguments = with_worker(folder / "scan.bin", folder / "worker.sh");
  arguments.insert(arguments.end(), {"--rounds", "300"});

  const Outcome outcome = run(arguments);

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json bench = json::parse(outcome.out);
  EXPECT_EQ(bench["rounds"], 300);
  EXPECT_EQ(bench["external_tools"]["pypatchworkpp-patchwork"]["left_out"],
            "its worker exited early");
  EXPECT_EQ(bench["external_tools"]["pypatchworkpp-patchwork"]["samples"], 1);
}

TEST(Bench, SkipsExternalToolsWithoutWorkerOrPython) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  const std::string scan = (folder / "scan.bin").string();
  put_fake_worker(folder / "worker.sh", "1");

  const Outcome no_worker = run({"bench", scan, "--rounds", "1", "--json", "--compare",
                                 "--compare-worker", (folder / "none.py").string()});
  const Outcome no_python =
      run({"bench", scan, "--rounds", "1", "--json", "--compare", "--python", "no-such-python",
           "--compare-worker", (folder / "worker.sh").string()});

  EXPECT_THAT(
      json::parse(no_worker.out)["external_tools"]["open3d-ransac"]["left_out"].get<std::string>(),
      HasSubstr("none.py: no such file"));
  EXPECT_THAT(
      json::parse(no_python.out)["external_tools"]["open3d-ransac"]["left_out"].get<std::string>(),
      HasSubstr("no-such-python cannot be started"));
}

TEST(Bench, PrintsTheMeasurementsWhenInterrupted) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  // The first answer is the warm-up, the second one the first round.
  put_fake_worker(folder / "worker.sh", "1", "[ $runs -lt 2 ] || kill -INT $PPID");

  std::vector<std::string> arguments = with_worker(folder / "scan.bin", folder / "worker.sh");
  arguments.insert(arguments.end(), {"--rounds", "1000000"});

  const Outcome outcome = run(arguments);

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("interrupted: 1 of 1000000 rounds were started"));
  const json bench = json::parse(outcome.out);
  EXPECT_EQ(bench["rounds"], 1);
  EXPECT_GT(bench["segment"]["median_ms"].get<double>(), 0);
}

TEST(BenchCommand, JsonListsUnreadableScans) {
  const io::TemporaryFolder folder;
  const std::string bad = (folder / "broken.bin").string();
  const std::string good = (folder / "good.bin").string();
  io::put_file(bad, "x");
  put_scan(good, small_scan(200));

  const Outcome alone = run({"bench", bad, "--json"});
  const Outcome beside = run({"bench", bad, good, "--rounds", "1", "--json"});

  for (const Outcome& outcome : {alone, beside}) {
    EXPECT_EQ(outcome.exit_code, 1);
    const auto errors = nlohmann::json::parse(outcome.out)["errors"];
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0]["file"], bad);
    EXPECT_THAT(errors[0]["error"].get<std::string>(), testing::HasSubstr(bad + ": byte "));
  }
  EXPECT_TRUE(nlohmann::json::parse(beside.out).contains("method"));
}

}  // namespace
}  // namespace flagstone::cli
