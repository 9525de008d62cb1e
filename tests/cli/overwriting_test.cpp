// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// No command overwrites its inputs: it prints one line and exits with 2 before it writes anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
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
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A directory with a scan, settings, a sensor, a protocol and a dataset.
class Overwriting : public testing::Test {
 protected:
  Overwriting() {
    put_scan(folder_ / "scan.bin");
    io::put_file(folder_ / "mine.toml", "[mount]\ntilt = \"off\"\n");
    io::put_file(folder_ / "sensor.toml",
                 "beams = 4\nelevation_top = 3.0\nelevation_bottom = -15.0\nheight = 0.6\n");
    io::put_file(folder_ / "protocol.toml", "name = \"mine\"\nground = [40]\n");
    for (const char* name : {"000000", "000001"}) {
      put_labelled(folder_ / "data", name, small_scan(400));
    }
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Runs a command, in which @NAME is a file of the directory. Expects one line that names output
  /// and input, exit code 2 and unchanged files.
  void expect_rejected(std::vector<std::string> words, const std::string& output,
                       const std::string& input) const {
    const auto before = files_below(folder_.path());
    std::string whole;
    for (std::string& word : words) {
      if (word.starts_with('@')) word = path(word.substr(1));
      whole += word + " ";
    }
    const Outcome outcome = run(words);

    EXPECT_EQ(outcome.exit_code, 2) << whole;
    EXPECT_EQ(outcome.out, "") << whole;
    EXPECT_THAT(outcome.err, AllOf(is_one_line_with(path(output) + ": this output would overwrite"),
                                   HasSubstr("the input " + path(input) + " ")))
        << whole;
    EXPECT_EQ(files_below(folder_.path()), before) << whole;
  }

  io::TemporaryFolder folder_;
};

TEST_F(Overwriting, IsRejectedForEveryOutputOfSegmentAndThroughLinks) {
  struct Case {
    std::string output;
    std::vector<std::string> options;
  };
  const std::vector<Case> cases = {
      {"scan.label", {}},
      {"scan.label.npy", {"--format", "u8"}},
      {"scan.npy", {"--format", "npy"}},
      {"scan.pcd", {"--format", "pcd"}},
      {"scan.ply", {"--format", "ply"}},
      {"scan.ground.bin", {"--format", "split"}},
      {"scan.nonground.bin", {"--format", "split"}},
      {"scan.heights.npy", {"--heights"}},
      {"scan.surface.npy", {"--surface"}},
      {"scan.surface.json", {"--surface"}},
      {"scan.surface.png", {"--surface"}},
      {"scan.png", {"--image"}},
  };
  fs::create_directory(folder_ / "out");
  for (const Case& each : cases) {
    std::vector<std::string> words = {"segment", "@scan.bin", "--output", "@out"};
    words.insert(words.end(), each.options.begin(), each.options.end());
    fs::create_hard_link(folder_ / "scan.bin", folder_ / "out" / each.output);
    expect_rejected(words, "out/" + each.output, "scan.bin");
    fs::remove(folder_ / "out" / each.output);
    fs::create_symlink(folder_ / "scan.bin", folder_ / "out" / each.output);
    expect_rejected(words, "out/" + each.output, "scan.bin");
    fs::remove(folder_ / "out" / each.output);
  }
}

TEST_F(Overwriting, IsRejectedForEveryInputOfSegment) {
  put_scan(folder_ / "other.bin");
  fs::create_directory(folder_ / "truth");
  io::put_file(folder_ / "truth/scan.label", std::string(16000, '\0'));
  const auto link = [&](const std::string& input) {
    fs::remove(folder_ / "scan.label");
    fs::create_hard_link(folder_ / input, folder_ / "scan.label");
  };
  const std::vector<std::string> segment = {"segment", "@scan.bin", "-o", "@."};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = segment;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };

  link("truth/scan.label");
  expect_rejected(with({"--reference", "@truth"}), "./scan.label", "truth/scan.label");
  expect_rejected(with({"--reference", "@scan.label"}), "./scan.label", "scan.label");
  link("mine.toml");
  expect_rejected(with({"--config", "@mine.toml"}), "./scan.label", "mine.toml");
  link("sensor.toml");
  expect_rejected(with({"--sensor", "@sensor.toml"}), "./scan.label", "sensor.toml");
  io::put_file(folder_ / "names-it.toml", "sensor = \"sensor.toml\"\n");
  expect_rejected(with({"--config", "@names-it.toml"}), "./scan.label", "sensor.toml");
  link("other.bin");
  expect_rejected({"segment", "@scan.bin", "@other.bin", "-o", "@."}, "./scan.label", "other.bin");
}

TEST_F(Overwriting, IsRejectedIfAScanHasTheNameOfAnOutput) {
  put_scan(folder_ / "d/x.pcd");
  put_scan(folder_ / "d/x.ground.pcd", small_scan(300));
  expect_rejected({"segment", "@d", "-o", "@d", "--format", "split"}, "d/x.ground.pcd",
                  "d/x.ground.pcd");

  put_scan(folder_ / "heights/k.bin");
  put_scan(folder_ / "heights/k.heights.npy", small_scan(300));
  expect_rejected({"segment", "@heights", "-o", "@heights", "--heights"}, "heights/k.heights.npy",
                  "heights/k.heights.npy");
  put_scan(folder_ / "k.bin");
  put_scan(folder_ / "k.heights.npy", small_scan(300));
  expect_rejected({"segment", "@k.bin", "@k.heights.npy", "-o", "@.", "--heights"},
                  "./k.heights.npy", "k.heights.npy");
}

TEST_F(Overwriting, IsRejectedForTwoOutputsInOneFile) {
  put_scan(folder_ / "k.bin");
  put_scan(folder_ / "k.heights.pcd");

  const Outcome outcome = run({"segment", path("k.bin"), path("k.heights.pcd"), "-o", path("out"),
                               "--heights", "--format", "npy"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("out/k.heights.npy: this output would overwrite"),
                                 HasSubstr("of the same run")));
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(Overwriting, SplittingADirectoryTwiceGivesTheSameResult) {
  put_scan(folder_ / "d/x.pcd");
  put_scan(folder_ / "d/y.bin");
  const std::vector<std::string> words = {"segment",  path("d"), "-o",       path("d"),
                                          "--format", "split",   "--heights"};
  ASSERT_EQ(run(words).exit_code, 0);
  const auto once = files_below(folder_ / "d");

  const Outcome again = run(words);

  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.err, is_one_line_with("/d: skipped 4 files that an earlier run of segment"));
  EXPECT_EQ(files_below(folder_ / "d"), once);
  EXPECT_THAT(lines_of(again.out), testing::Contains(HasSubstr("2 of 2 scans segmented")));
}

TEST_F(Overwriting, IsRejectedForTheSettingsThatDoctorWrites) {
  expect_rejected({"doctor", "@scan.bin", "-o", "@scan.bin"}, "scan.bin", "scan.bin");
  expect_rejected({"doctor", "@scan.bin", "--config", "@mine.toml", "-o", "@mine.toml"},
                  "mine.toml", "mine.toml");
  expect_rejected({"doctor", "@scan.bin", "--sensor", "@sensor.toml", "-o", "@sensor.toml"},
                  "sensor.toml", "sensor.toml");
}

TEST_F(Overwriting, IsRejectedForADemoInADataset) {
  const auto before = files_below(folder_ / "data");

  const Outcome outcome = run({"demo", "-o", path("data")});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, is_one_line_with("data/velodyne/000000.bin: was not written by a demo"));
  EXPECT_EQ(files_below(folder_ / "data"), before);
}

}  // namespace
}  // namespace flagstone::cli
