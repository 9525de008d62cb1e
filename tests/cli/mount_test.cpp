// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Sensors of unknown height or tilt: --sensor-height, --tilt, the table [mount].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
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
using testing::HasSubstr;

/// Level ground around a sensor at this height, a box on the ground and one missing return; rotated
/// about y by `pitch` degrees.
io::Cloud yard(float height, float pitch = 0) {
  std::vector<float> points;
  const float c = std::cos(pitch * 0.0174533f);
  const float s = std::sin(pitch * 0.0174533f);
  const auto add = [&](float x, float y, float z) {
    points.insert(points.end(), {c * x - s * z, y, s * x + c * z, 0});
  };
  for (int ring = 0; ring < 24; ++ring) {
    const float range = 3 + 0.5f * static_cast<float>(ring);
    for (int i = 0; i < 300; ++i) {
      const float azimuth = static_cast<float>(i) * 0.0209440f;
      add(range * std::cos(azimuth), range * std::sin(azimuth), -height);
    }
  }
  for (float y = -2; y < 2; y += 0.1f) {
    for (float z = 0; z < 1.5f; z += 0.1f) add(6, y, z - height);
  }
  points.insert(points.end(), {0, 0, 0, 0});
  io::Cloud cloud;
  EXPECT_TRUE(io::Cloud::from_floats(points, 4, cloud).ok());
  return cloud;
}

class MountOfScans : public testing::Test {
 protected:
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Segments the directory of scans.
  [[nodiscard]] Outcome segment(const std::vector<std::string>& more,
                                const std::string& output = "out") const {
    std::vector<std::string> arguments = {"segment",    path("scans"), "--output",
                                          path(output), "--method",    "patchwork"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_F(MountOfScans, EstimatesTheHeightFromTheFirstScanThatDeterminesIt) {
  put_scan(folder_ / "scans/0.bin", small_scan(30));
  put_scan(folder_ / "scans/1.bin", yard(0.8f));
  put_scan(folder_ / "scans/2.bin", yard(0.8f));

  const Outcome outcome = segment({"--sensor-height", "estimate"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(lines_of(outcome.out)[0],
              AllOf(HasSubstr("mount: sensor 0.80 m above the ground, confidence"),
                    HasSubstr("(estimated from " + path("scans/1.bin") + ")")));
}

TEST_F(MountOfScans, EstimatedHeightGivesTheLabelsOfTheExpectedHeight) {
  put_scan(folder_ / "scans/0.bin", yard(4.2f));
  put_scan(folder_ / "usual/0.bin", yard(1.73f));
  ASSERT_EQ(run({"segment", path("usual"), "--output", path("expected"), "--method", "patchwork"})
                .exit_code,
            0);

  const Outcome wrong = segment({"--sensor-height", "1.73"}, "wrong");
  const Outcome estimated = segment({"--sensor-height", "estimate"}, "estimated");

  ASSERT_EQ(wrong.exit_code, 0) << wrong.err;
  ASSERT_EQ(estimated.exit_code, 0) << estimated.err;
  const auto expected = codes_of(folder_ / "expected/0.label");
  const auto different = [&](const std::string& output) {
    const auto codes = codes_of(folder_ / output / "0.label");
    std::size_t count = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) count += codes[i] != expected[i] ? 1U : 0U;
    return count;
  };
  EXPECT_LT(different("estimated"), 20U);
  EXPECT_GT(different("wrong"), 100U);
}

TEST_F(MountOfScans, EstimateDoesNotDependOnTheNumberOfThreads) {
  for (int i = 0; i < 8; ++i) {
    put_scan(folder_ / ("scans/" + std::to_string(i) + ".bin"),
             yard(1 + 0.1f * static_cast<float>(i), 10));
  }
  const std::vector<std::string> estimate = {"--sensor-height", "estimate", "--tilt", "estimate"};
  auto four = estimate;
  four.insert(four.end(), {"--threads", "4"});

  ASSERT_EQ(segment(estimate, "one").exit_code, 0);
  ASSERT_EQ(segment(four, "four").exit_code, 0);

  EXPECT_EQ(files_below(folder_ / "one"), files_below(folder_ / "four"));
}

TEST_F(MountOfScans, UsesTheConfiguredHeightIfNoScanDeterminesIt) {
  for (int i = 0; i < 25; ++i) {
    put_scan(folder_ / ("scans/" + std::to_string(i + 10) + ".bin"), small_scan(5));
  }

  const Outcome outcome = segment({"--sensor-height", "estimate"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(
      lines_of(outcome.out)[0],
      AllOf(HasSubstr("mount: sensor 1.73 m above the ground, as configured"),
            HasSubstr("(the first 20 scans do not determine it; "), HasSubstr("too few points")));
}

TEST_F(MountOfScans, TiltedSensorGetsTheLabelsOfALevelSensor) {
  put_scan(folder_ / "scans/0.bin", yard(1.73f, 20));
  put_scan(folder_ / "level/0.bin", yard(1.73f));
  ASSERT_EQ(run({"segment", path("level"), "--output", path("expected"), "--method", "patchwork"})
                .exit_code,
            0);

  const Outcome estimated = segment({"--tilt", "estimate"}, "estimated");
  const Outcome given = segment({"--tilt", "-3.355,0,9.218"}, "given");

  EXPECT_THAT(lines_of(estimated.out)[0], HasSubstr("tilted by 20.0 degrees"));
  EXPECT_EQ(given.exit_code, 0) << given.err;
  const auto expected = codes_of(folder_ / "expected/0.label");
  for (const char* output : {"estimated", "given"}) {
    const auto codes = codes_of(folder_ / output / "0.label");
    ASSERT_EQ(codes.size(), expected.size());
    std::size_t different = 0;
    for (std::size_t i = 0; i < codes.size(); ++i) different += codes[i] != expected[i] ? 1U : 0U;
    EXPECT_LT(different, expected.size() / 50) << output;
    EXPECT_EQ(codes.back(), 4U) << output;  // missing return
  }
}

TEST_F(MountOfScans, PrintsTheTrackedHeightOfEveryScanInOrder) {
  for (int i = 0; i < 3; ++i) {
    put_scan(folder_ / ("scans/" + std::to_string(i) + ".bin"),
             yard(1 + 0.04f * static_cast<float>(i)));
  }
  put_scan(folder_ / "scans/3.bin", yard(2));

  const Outcome outcome = segment({"--sensor-height", "track"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  EXPECT_THAT(lines[0], HasSubstr("sensor height 1.00 m: sensor 1.00 m above the ground"));
  EXPECT_THAT(lines[1], HasSubstr("sensor height 1.02 m: sensor 1.04 m above the ground"));
  EXPECT_THAT(lines[2], HasSubstr("sensor height 1.04 m: sensor 1.08 m above the ground"));
  EXPECT_THAT(lines[3], AllOf(HasSubstr("sensor height 1.04 m: no estimate from this scan"),
                              HasSubstr("too far from the estimates of previous scans")));
}

TEST_F(MountOfScans, JsonHasTheDecisionAndItsReason) {
  put_scan(folder_ / "scans/0.bin", yard(0.8f));

  const Outcome estimated = segment({"--sensor-height", "estimate", "--json"});
  const Outcome fixed = segment({"--json"});

  const auto json = nlohmann::json::parse(estimated.out);
  EXPECT_NEAR(json["mount"]["sensor_height"].get<double>(), 0.8, 0.01);
  EXPECT_EQ(json["mount"]["up"].size(), 3U);
  EXPECT_EQ(json["mount"]["verdict"], "accepted");
  EXPECT_GT(json["mount"]["confidence"].get<double>(), 0.9);
  EXPECT_THAT(json["mount"]["why"].get<std::string>(), HasSubstr("above the ground"));
  EXPECT_FALSE(nlohmann::json::parse(fixed.out).contains("mount"));
}

TEST_F(MountOfScans, ReadsTheTableOfAConfiguration) {
  put_scan(folder_ / "scans/0.bin", yard(1.73f, 20));
  io::put_file(folder_ / "mine.toml",
               "[mount]\ntilt = \"fixed\"\nup = [-0.342, 0, 0.94]\norigin = [0, 0, 0]\n");

  const Outcome by_file = segment({"--config", path("mine.toml")}, "file");
  const Outcome by_option = segment({"--tilt", "-0.342,0,0.94"}, "option");

  EXPECT_EQ(by_file.exit_code, 0) << by_file.err;
  EXPECT_EQ(files_below(folder_ / "file"), files_below(folder_ / "option"));
}

TEST_F(MountOfScans, IsPrintedWithTheConfigurationAndReadBack) {
  const Outcome printed = run({"config", "--sensor-height", "track", "--tilt", "0,0.5,1"});
  io::put_file(folder_ / "mine.toml", printed.out);

  const Outcome again = run({"config", "--config", path("mine.toml")});

  EXPECT_THAT(printed.out, AllOf(HasSubstr("\n[mount]\n"), HasSubstr("height = \"track\""),
                                 HasSubstr("tilt = \"fixed\""), HasSubstr("up = [0.0, 0.5, 1.0]")));
  EXPECT_EQ(again.out, printed.out);
}

TEST_F(MountOfScans, EvalEstimatesEveryScanSeparately) {
  for (int i = 0; i < 4; ++i) {
    put_labelled(folder_ / "set", std::to_string(i), yard(0.7f + 0.4f * static_cast<float>(i)));
  }
  const auto scores = [&](const std::string& threads) {
    const Outcome outcome = run({"eval", path("set"), "--methods", "patchwork", "--sensor-height",
                                 "estimate", "--threads", threads, "--json", path("r.json")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return without_times(json_of(folder_ / "r.json"));
  };

  EXPECT_EQ(scores("1"), scores("3"));
}

TEST_F(MountOfScans, EvalAcceptsMountSettings) {
  put_labelled(folder_ / "set", "0", yard(1.73f));

  const Outcome right = run({"eval", path("set"), "--methods", "surface", "--set",
                             "mount.tilt=\"estimate\"", "--set", "mount.max_tilt=12"});
  const Outcome wrong =
      run({"eval", path("set"), "--methods", "surface", "--set", "mount.max_tilt=80"});

  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, is_one_line_with("mount.max_tilt = 80 is out of range"));
}

TEST_F(MountOfScans, BenchAndSweepAcceptIt) {
  put_labelled(folder_ / "set", "0", yard(1.73f, 15));

  const Outcome bench = run({"bench", path("set/velodyne"), "--rounds", "1", "--tilt", "estimate"});
  const Outcome sweep = run({"sweep", path("set"), "--method", "patchwork", "--param",
                             "sensor_height=1.5,1.73", "--tilt", "estimate"});

  EXPECT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(sweep.exit_code, 0) << sweep.err;
}

TEST_F(MountOfScans, RejectsInvalidValuesOnOneLine) {
  put_scan(folder_ / "scans/0.bin", yard(1.73f));
  io::put_file(folder_ / "height.toml", "[mount]\nheight = \"guess\"\n");
  io::put_file(folder_ / "up.toml", "[mount]\nup = [1, 2]\n");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
    const Outcome outcome = segment(more);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, is_one_line_with(part));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  };

  refused({"--sensor-height", "high"},
          "'high' is not a height (expected metres, estimate or track)");
  refused({"--tilt", "1,2"},
          "'1,2' is not a tilt (expected off, estimate or the up direction X,Y,Z)");
  refused({"--tilt", "0,0,0"}, "length of mount.up = 0");
  refused({"--tilt", "0,nan,1"}, "mount.up[1] = nan is out of range");
  refused({"--sensor-height", "track", "--threads", "2"},
          "--threads 2: a tracked sensor height needs one thread");
  refused({"--config", path("height.toml")},
          R"(mount.height must be one of "fixed", "estimate", "track")");
  refused({"--config", path("up.toml")}, "mount.up must be an array of three numbers");
  refused({"--set", "mount.reach=1"}, "mount.reach = 1 is out of range (expected 2 to 100 m)");
}

}  // namespace
}  // namespace flagstone::cli
