// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/npy.hpp"
#include "files/io/status_matchers.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

std::vector<std::string> arguments(const fs::path& output, const std::string& scene,
                                   const std::vector<std::string>& more) {
  std::vector<std::string> all{"simulate", "--scene", scene, "--output", output.string()};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

Outcome simulate(const fs::path& output, const std::string& scene,
                 const std::vector<std::string>& more) {
  return run(arguments(output, scene, more));
}

TEST(SimulateCommand, WritesASequenceInTheLayoutOfSemanticKitti) {
  const io::TemporaryFolder folder;

  const Outcome outcome =
      simulate(folder / "out", "parked_cars", {"--frames", "2", "--sequence", "07", "--seed", "5"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 frames in 1 environment, 2 simulated, 0 kept"));
  const fs::path sequence = folder / "out" / "sequences" / "07";
  EXPECT_THAT(
      names_below(folder / "out"),
      ElementsAre("sequences/07/calib.txt", "sequences/07/ground/000000.ground.npy",
                  "sequences/07/ground/000001.ground.npy", "sequences/07/labels/000000.label",
                  "sequences/07/labels/000001.label", "sequences/07/motion/000000.motion.npy",
                  "sequences/07/motion/000001.motion.npy", "sequences/07/poses.txt",
                  "sequences/07/returns/000000.return.npy",
                  "sequences/07/returns/000001.return.npy", "sequences/07/scene.json",
                  "sequences/07/times.txt", "sequences/07/velodyne/000000.bin",
                  "sequences/07/velodyne/000001.bin"));
  auto files = files_below(sequence);
  for (const std::string frame : {"000000", "000001"}) {
    const std::size_t points = files["velodyne/" + frame + ".bin"].size() / 16;
    EXPECT_GT(points, 50'000U);
    EXPECT_EQ(files["labels/" + frame + ".label"].size(), 4 * points);
    std::vector<float> ground;
    EXPECT_THAT(io::read_height_file(sequence / "ground" / (frame + ".ground.npy"), points, ground),
                io::is_ok());
    std::vector<std::uint32_t> returns;
    EXPECT_THAT(io::read_reference(sequence / "returns" / (frame + ".return.npy"), points, returns),
                io::is_ok());
  }
  EXPECT_NE(files["velodyne/000000.bin"], files["velodyne/000001.bin"]);
  EXPECT_THAT(files["calib.txt"], HasSubstr("Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n"));
  const std::vector<std::string> poses = lines_of(files["poses.txt"]);
  ASSERT_THAT(poses, SizeIs(2));
  std::istringstream numbers(poses[0]);
  EXPECT_THAT(std::vector<double>(std::istream_iterator<double>(numbers), {}), SizeIs(12));
  const auto scene = nlohmann::json::parse(files["scene.json"]);
  EXPECT_EQ(scene["scene"], "parked_cars");
  EXPECT_EQ(scene["sensor"]["name"], "hdl-64e");
  EXPECT_THAT(scene["sensor"]["elevations"], SizeIs(64));
  EXPECT_EQ(scene["mount"]["height"], 1.73);
  EXPECT_EQ(scene["noise"]["name"], "default");
  EXPECT_EQ(scene["weather"], nlohmann::json::array({"clear"}));
  EXPECT_EQ(scene["seed"], 5);
  EXPECT_EQ(scene["frames"], 2);
  ASSERT_THAT(scene["drives"], SizeIs(1));
  EXPECT_EQ(scene["drives"][0]["first_frame"], 0);
}

TEST(SimulateCommand, WritesASequenceForSegmentAndEval) {
  const io::TemporaryFolder folder;
  const std::string tree = (folder / "tree").string();
  ASSERT_EQ(simulate(tree, "steps", {"--frames", "2"}).exit_code, 0);

  const Outcome segmented = run({"segment", tree, "--output", (folder / "out").string()});
  const Outcome judged = run({"eval", tree, "--protocol", "simulation", "--methods", "surface"});

  EXPECT_EQ(segmented.exit_code, 0) << segmented.err;
  EXPECT_THAT(names_below(folder / "out"), SizeIs(2)) << "ground files are not scans";
  EXPECT_EQ(judged.exit_code, 0) << judged.err;
  EXPECT_THAT(judged.out, HasSubstr("Error of the height above the ground"));
}

TEST(SimulateCommand, WritesTheKindOfEveryReturnInTheRain) {
  const io::TemporaryFolder folder;

  const Outcome outcome =
      simulate(folder / "out", "steps",
               {"--frames", "1", "--sensor", "livox-avia", "--sensor-height", "2.5", "--tilt",
                "15,-5", "--weather", "rain,dust", "--noise", "harsh", "--keep-no-returns"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const fs::path sequence = folder / "out" / "sequences" / "00";
  auto files = files_below(sequence);
  const std::size_t points = files["velodyne/000000.bin"].size() / 16;
  EXPECT_EQ(points, 24'000U) << "one for every beam";
  std::vector<std::uint32_t> returns;
  std::vector<std::uint32_t> classes;
  ASSERT_THAT(io::read_reference(sequence / "returns" / "000000.return.npy", points, returns),
              io::is_ok());
  ASSERT_THAT(io::read_reference(sequence / "labels" / "000000.label", points, classes),
              io::is_ok());
  for (std::size_t i = 0; i < points; ++i) {
    constexpr std::uint32_t surface = 0;
    constexpr std::uint32_t none = 6;
    constexpr std::uint32_t outlier = 1;
    EXPECT_EQ(classes[i] == outlier, returns[i] != surface && returns[i] != none);
    EXPECT_EQ(classes[i] == 0, returns[i] == none);
  }
  const auto scene = nlohmann::json::parse(files["scene.json"]);
  EXPECT_EQ(scene["sensor"]["rosette"], nlohmann::json::array({61.803, -38.197}));
  EXPECT_EQ(scene["mount"], nlohmann::json::parse(R"({"height": 2.5, "pitch": 15, "roll": -5})"));
  EXPECT_EQ(scene["weather"], nlohmann::json::array({"rain", "dust"}));
  EXPECT_EQ(scene["noise"]["rain_rate"], 0.02);
  EXPECT_EQ(scene["no_returns_kept"], true);
  EXPECT_EQ(scene["classes"]["40"], "road");
  EXPECT_EQ(scene["files"]["returns"], "returns/NNNNNN.return.npy");
}

// The numbers of each line.
std::vector<std::vector<double>> poses_of(const std::string& text) {
  std::vector<std::vector<double>> poses;
  for (const std::string& line : lines_of(text)) {
    std::istringstream numbers(line);
    poses.emplace_back(std::istream_iterator<double>(numbers), std::istream_iterator<double>());
  }
  return poses;
}

TEST(SimulateCommand, WritesAContinuousRunWithMovingTraffic) {
  const io::TemporaryFolder folder;

  const Outcome outcome = simulate(folder / "out", "urban_street",
                                   {"--frames", "3", "--rate", "10", "--sensor", "vlp-16",
                                    "--noise", "clean", "--pose-noise", "jitter"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const fs::path sequence = folder / "out" / "sequences" / "00";
  auto files = files_below(sequence);
  const auto exact = poses_of(files["poses.txt"]);
  const auto measured = poses_of(files["poses_measured.txt"]);
  ASSERT_THAT(exact, SizeIs(3));
  ASSERT_THAT(measured, SizeIs(3));
  constexpr std::size_t x = 3;
  EXPECT_NEAR(exact[2][x] - exact[0][x], 1.6, 0.4) << "0.8 m between scans";
  EXPECT_NE(measured[2][x], exact[2][x]);
  EXPECT_NEAR(measured[2][x], exact[2][x], 0.1);
  const std::size_t points = files["velodyne/000002.bin"].size() / 16;
  std::vector<std::uint32_t> motion;
  std::vector<std::uint32_t> classes;
  ASSERT_THAT(io::read_reference(sequence / "motion" / "000002.motion.npy", points, motion),
              io::is_ok());
  ASSERT_THAT(io::read_reference(sequence / "labels" / "000002.label", points, classes),
              io::is_ok());
  std::size_t moving = 0;
  for (std::size_t i = 0; i < points; ++i) {
    constexpr std::uint32_t now = 2;
    ASSERT_EQ(classes[i] >= 252, motion[i] == now);
    moving += motion[i] == now;
  }
  EXPECT_GT(moving, 100U);
  const auto scene = nlohmann::json::parse(files["scene.json"]);
  EXPECT_EQ(scene["rate"], 10);
  EXPECT_EQ(scene["speed"], 8);
  EXPECT_EQ(scene["pose_noise"], "jitter");
  EXPECT_EQ(scene["classes"]["252"], "moving-car");
  EXPECT_EQ(scene["motions"]["2"], "now");
}

TEST(SimulateCommand, RejectsARateOrSpeedOutOfRange) {
  const io::TemporaryFolder folder;
  for (const auto& [option, value] :
       {std::pair{"--rate", "0"}, {"--rate", "nan"}, {"--rate", "101"}, {"--speed", "31"}}) {
    const Outcome outcome = simulate(folder / "out", "steps", {option, value});

    EXPECT_EQ(outcome.exit_code, 2) << option << ' ' << value;
    EXPECT_THAT(outcome.err, HasSubstr(option));
  }
  const Outcome unknown = simulate(folder / "out", "steps", {"--pose-noise", "jiter"});

  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("jitter"));
}

TEST(SimulateCommand, ReadsASensorFromAFile) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "mine.toml",
               "beams = 4\nelevation_top = -5.0\nelevation_bottom = -20.0\nfirings = 100\n"
               "height = 1.0\n");

  const Outcome outcome = simulate(folder / "out", "steps",
                                   {"--frames", "1", "--noise", "clean", "--keep-no-returns",
                                    "--sensor", (folder / "mine.toml").string()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  auto files = files_below(folder / "out" / "sequences" / "00");
  EXPECT_EQ(files["velodyne/000000.bin"].size(), 400U * 16);
  const auto scene = nlohmann::json::parse(files["scene.json"]);
  EXPECT_EQ(scene["sensor"]["elevations"], nlohmann::json::array({-5, -10, -15, -20}));
}

TEST(SimulateCommand, OutputDoesNotDependOnThreadsOrExistingFrames) {
  const io::TemporaryFolder folder;
  const fs::path resumed = folder / "resumed" / "sequences" / "00";

  const Outcome whole =
      simulate(folder / "whole", "bumpy_field", {"--frames", "12", "--threads", "1"});
  const Outcome begun =
      simulate(folder / "resumed", "bumpy_field", {"--frames", "5", "--threads", "2"});
  fs::remove(resumed / "velodyne" / "000001.bin");
  fs::resize_file(resumed / "labels" / "000002.label", 1000);
  fs::remove(resumed / "ground" / "000003.ground.npy");
  fs::resize_file(resumed / "returns" / "000004.return.npy", 200);
  fs::remove(resumed / "motion" / "000000.motion.npy");
  const Outcome finished =
      simulate(folder / "resumed", "bumpy_field", {"--frames", "12", "--threads", "2"});

  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.out, HasSubstr("12 frames in 2 environments, 12 simulated, 0 kept"));
  const auto expected = files_below(folder / "whole");
  const auto files = files_below(folder / "resumed");
  EXPECT_THAT(files, SizeIs(expected.size()));
  for (const auto& [name, contents] : expected) {
    EXPECT_TRUE(files.contains(name) && files.at(name) == contents) << name;
  }
}

TEST(SimulateCommand, LongRunDoesNotDependOnThreadsOrExistingFrames) {
  const io::TemporaryFolder folder;
  const auto simulated = [&](const char* name, const char* frames, const char* threads) {
    const Outcome outcome =
        simulate(folder / name, "highway",
                 {"--frames", frames, "--threads", threads, "--length", "700", "--loop", "--speed",
                  "30", "--rate", "0.3", "--sensor", "vlp-16", "--pose-noise", "drift"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return files_below(folder / name);
  };

  const auto expected = simulated("one", "9", "1");
  const auto seven = simulated("seven", "9", "7");
  simulated("resumed", "4", "2");
  fs::remove(folder / "resumed" / "sequences" / "00" / "velodyne" / "000002.bin");
  const auto resumed = simulated("resumed", "9", "2");

  const auto scene = nlohmann::json::parse(expected.at("sequences/00/scene.json"));
  EXPECT_EQ(scene["length"], 720);
  EXPECT_EQ(scene["loop"], true);
  EXPECT_THAT(scene["drives"], SizeIs(1)) << "the second lap is in the same environment";
  EXPECT_EQ(seven == expected, true);
  EXPECT_EQ(resumed == expected, true);
}

TEST(SimulateCommand, WritesTheTimeOfEveryPointWithMotionDistortion) {
  const io::TemporaryFolder folder;
  const std::vector<std::string> options{"--frames",     "2",        "--rate", "10",
                                         "--distortion", "--sensor", "vlp-16"};
  const fs::path sequence = folder / "out" / "sequences" / "00";

  const Outcome outcome = simulate(folder / "out", "park", options);
  auto files = files_below(sequence);
  fs::remove(sequence / "times" / "000001.time.npy");
  const Outcome resumed = simulate(folder / "out", "park", options);

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::size_t points = files["velodyne/000001.bin"].size() / 16;
  std::vector<float> times;
  ASSERT_THAT(io::read_height_file(sequence / "times" / "000001.time.npy", points, times),
              io::is_ok());
  for (const float time : times) {
    ASSERT_GE(time, 0);
    ASSERT_LT(time, 0.1F);
  }
  const auto scene = nlohmann::json::parse(files["scene.json"]);
  EXPECT_EQ(scene["distortion"], true);
  EXPECT_EQ(scene["files"]["times"], "times/NNNNNN.time.npy");
  EXPECT_THAT(resumed.out, HasSubstr("1 simulated, 1 kept"));
  EXPECT_EQ(files_below(sequence) == files, true);
}

TEST(SimulateCommand, RejectsALengthThatTheSceneCannotHave) {
  const io::TemporaryFolder folder;

  const Outcome fixed = simulate(folder / "out", "ramp", {"--length", "500"});
  const Outcome short_loop = simulate(folder / "out", "park", {"--length", "300", "--loop"});
  const Outcome fixed_loop = simulate(folder / "out", "steps", {"--length", "900", "--loop"});
  const Outcome endless = simulate(folder / "out", "park", {"--length", "1e9"});

  for (const Outcome& refused : {fixed, short_loop, fixed_loop, endless}) {
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, is_one_line_with("--length"));
  }
  EXPECT_THAT(fixed.err, HasSubstr("ramp is always 72 m long"));
  EXPECT_THAT(short_loop.err, HasSubstr("expected 700 to 20000 m with --loop"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(SimulateCommand, FinishesTheFramesInProgressWhenInterrupted) {
  const io::TemporaryFolder folder;
  CommandProcess command(arguments(folder / "out", "flat_street", {"--frames", "5000"}));
  const fs::path first = folder / "out" / "sequences" / "00" / "labels" / "000000.label";
  for (int wait = 0; wait < 600 && !fs::exists(first); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }

  command.send(SIGINT);
  const Outcome outcome = command.finish();

  EXPECT_EQ(outcome.exit_code, 1);
  auto files = files_below(folder / "out" / "sequences" / "00");
  std::size_t frames = 0;
  for (const auto& [name, contents] : files) {
    if (!name.ends_with(".bin")) continue;
    const std::string stem = fs::path(name).stem().string();
    EXPECT_EQ(4 * files["labels/" + stem + ".label"].size(), contents.size()) << name;
    EXPECT_TRUE(files.contains("ground/" + stem + ".ground.npy")) << name;
    ++frames;
  }
  EXPECT_GT(frames, 0U);
  EXPECT_THAT(outcome.err,
              is_one_line_with("interrupted: " + std::to_string(frames) + " of 5000 frames"));
}

TEST(SimulateCommand, ReportsAnUnknownSceneAndTheKnownOnes) {
  const io::TemporaryFolder folder;

  const Outcome outcome = simulate(folder / "out", "moon", {});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              is_one_line_with("--scene: no scene is named 'moon' (expected flat_street, "
                               "steep_street, parked_cars, bushes_and_lawn, "
                               "bumpy_field, steps"));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(SimulateCommand, RejectsInvalidValuesOnOneLine) {
  const io::TemporaryFolder folder;
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--frames", "0"},
                                                {"--frames", "100001"},
                                                {"--frames", "ten"},
                                                {"--seed", "-1"},
                                                {"--seed", "18446744073709551616"},  // 2^64
                                                {"--seed", std::string(309, '9')},
                                                {"--sensor-height", "nan"},
                                                {"--threads", "0"},
                                                {"--sequence", "7"},
                                                {"--sensor", "hdl-65"},
                                                {"--sensor-height", "-1"},
                                                {"--tilt", "5"},
                                                {"--tilt", "5,x"},
                                                {"--tilt", "5,91"},
                                                {"--tilt", "nan,0"},
                                                {"--weather", "rain,hail"},
                                                {"--noise", "loud"},
                                                {"--sequence", "../"}}) {
    const Outcome outcome = simulate(folder / "out", "flat_street", wrong);

    EXPECT_EQ(outcome.exit_code, 2) << wrong[0] << ' ' << wrong[1];
    EXPECT_THAT(outcome.err, is_one_line_with(wrong[0]));
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(SimulateCommand, RejectsADirectoryWithOtherData) {
  const io::TemporaryFolder folder;
  const fs::path velodyne = folder / "kitti" / "sequences" / "00" / "velodyne";
  fs::create_directories(velodyne);
  io::put_file(velodyne / "000000.bin", "recorded");

  const Outcome outcome = simulate(folder / "kitti", "flat_street", {"--frames", "1"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, is_one_line_with("contains files that are not a simulated sequence"));
  EXPECT_THAT(names_below(folder / "kitti"), ElementsAre("sequences/00/velodyne/000000.bin"));
}

TEST(SimulateCommand, RejectsMixedSequencesAndFewerFrames) {
  const io::TemporaryFolder folder;
  const Outcome first = simulate(folder / "out", "flat_street", {"--frames", "2"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const auto before = files_below(folder / "out");

  const Outcome other_scene = simulate(folder / "out", "parked_cars", {"--frames", "2"});
  const Outcome other_seed =
      simulate(folder / "out", "flat_street", {"--frames", "2", "--seed", "9"});
  const Outcome other_sensor =
      simulate(folder / "out", "flat_street", {"--frames", "2", "--sensor", "vlp-16"});
  const Outcome other_tilt =
      simulate(folder / "out", "flat_street", {"--frames", "2", "--tilt", "0,1"});
  const Outcome other_weather =
      simulate(folder / "out", "flat_street", {"--frames", "2", "--weather", "wet"});
  const Outcome fewer = simulate(folder / "out", "flat_street", {"--frames", "1"});

  for (const Outcome& refused :
       {other_scene, other_seed, other_sensor, other_tilt, other_weather, fewer}) {
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, is_one_line_with("choose another --output or --sequence"));
  }
  EXPECT_EQ(files_below(folder / "out") == before, true);
}

TEST(SimulateCommand, ReportsAnOutputDirectoryThatCannotBeCreated) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "taken", "mine");

  const Outcome outcome = simulate(folder / "taken", "flat_street", {"--frames", "1"});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("cannot be created"));
}

}  // namespace
}  // namespace flagstone::cli
