// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/mapping/map_run.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "app/mapping/map_outputs.hpp"
#include "app/simulate.hpp"
#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/read_cloud.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/surface.hpp"

namespace flagstone::app {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t frames = 24;

/// A simulated run with traffic: 24 scans of a VLP-16, 10 per second.
class MapRun : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new io::TemporaryFolder;
    simulate({.output = folder->path(),
              .scene = "crossroads",
              .sensor = "vlp-16",
              .frames = frames,
              .pace = {.rate = 10, .speed = 8}},
             {});
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
  }

  static fs::path run() { return folder->path() / "sequences" / "00"; }
  static fs::path poses() { return run() / "poses.txt"; }

  MapRequest request(const std::string& output) const {
    config::MethodChoice choice;
    choice.sensor = "vlp-16";
    return {.run = run(),
            .poses = poses(),
            .output = out.path() / output,
            .method = config::resolve_one(choice),
            .threads = 2};
  }

  MapOutcome map(const MapRequest& request) {
    messages.clear();
    return map_run(
        request, {.run = {.message = [&](const std::string& line) { messages.push_back(line); }}});
  }

  /// Lines of the file of poses.
  static std::vector<std::string> pose_lines() {
    std::vector<std::string> lines;
    std::istringstream file(io::contents_of(poses()));
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }
  fs::path put_poses(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    io::put_file(out / "changed.txt", text);
    return out / "changed.txt";
  }

  /// The labels of a scan alone.
  static std::vector<std::uint32_t> own_labels(std::size_t scan) {
    io::Cloud cloud;
    EXPECT_TRUE(
        io::read_cloud(run() / "velodyne" / fmt::format("{:06}.bin", scan), {}, cloud).ok());
    config::MethodChoice choice;
    choice.sensor = "vlp-16";
    const config::ResolvedMethod method = config::resolve_one(choice);
    Surface surface(*method.config.get_if<SurfaceConfig>());
    Segmentation result;
    EXPECT_TRUE(surface.segment(cloud.view(), result).ok());
    std::vector<std::uint32_t> codes;
    for (const Label label : result.labels()) codes.push_back(static_cast<std::uint32_t>(label));
    return codes;
  }

  static std::vector<std::uint32_t> codes(const MapRequest& request, std::size_t scan) {
    return cli::codes_of(request.output / "labels" / fmt::format("{:06}.label", scan));
  }

  static io::TemporaryFolder* folder;
  io::TemporaryFolder out;
  std::vector<std::string> messages;
};

io::TemporaryFolder* MapRun::folder = nullptr;

TEST_F(MapRun, WritesLabelsMovingPointsMapAndStaticCloud) {
  MapRequest wanted = request("map");
  wanted.heights = true;
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.scans, frames);
  EXPECT_EQ(outcome.mapped, frames);
  EXPECT_EQ(outcome.alone + outcome.failed, 0U);
  EXPECT_GT(outcome.moving_points, 0U);
  EXPECT_NEAR(outcome.path, 0.8 * (frames - 1), 0.5);
  // A VLP-16 has few beams.
  EXPECT_THAT(messages, ElementsAre(HasSubstr("2.0 degrees between beams")));

  const std::vector<std::string> names = cli::names_below(wanted.output);
  for (const char* name : {"run.json", "poses.txt", "objects.csv", "ground.png", "static.ply",
                           "ground/map.json", "labels/000000.label", "labels/000023.label",
                           "moving/000023.moving.npy", "heights/000023.heights.npy"}) {
    EXPECT_THAT(names, Contains(name));
  }
  for (const std::string& name : names) EXPECT_THAT(name, testing::Not(HasSubstr("state")));
}

TEST_F(MapRun, MovingPointsAreNotGroundAndTheirObjectsAreListed) {
  const MapRequest wanted = request("map");
  map(wanted);
  std::set<std::string> listed;
  std::istringstream table(io::contents_of(wanted.output / "objects.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "scan,object,points,confidence,min_x,min_y,min_z,max_x,max_y,max_z");
  while (std::getline(table, line)) listed.insert(line.substr(0, line.find(',', 7)));
  EXPECT_FALSE(listed.empty());
  const MapOutputs files{.directory = wanted.output};
  for (std::size_t scan = 0; scan < frames; ++scan) {
    const std::string name = fmt::format("{:06}", scan);
    const std::vector<std::uint32_t> labels = codes(wanted, scan);
    MovingMask moving;
    ASSERT_TRUE(read_moving(files.moving(name), labels.size(), moving).ok());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (moving.objects_of_points[i] == 0) continue;
      ASSERT_EQ(labels[i], static_cast<std::uint32_t>(Label::nonground));
      ASSERT_TRUE(listed.contains(fmt::format("{},{}", name, moving.objects_of_points[i])));
    }
  }
}

TEST_F(MapRun, WritesIdenticalFilesWithAnyNumberOfThreads) {
  std::vector<std::map<std::string, std::string>> outputs;
  for (const unsigned threads : {1U, 2U, 7U}) {
    MapRequest wanted = request("map");
    wanted.threads = threads;
    wanted.heights = true;
    map(wanted);
    outputs.push_back(cli::files_below(wanted.output));
    fs::remove_all(wanted.output);
  }
  EXPECT_EQ(outputs[0], outputs[1]);
  EXPECT_EQ(outputs[0], outputs[2]);
}

TEST_F(MapRun, ALimitOfTheMemoryDoesNotChangeTheOutput) {
  MapRequest wanted = request("map");
  wanted.map_memory = 0;
  map(wanted);
  auto files = cli::files_below(wanted.output);
  fs::remove_all(wanted.output);
  wanted.map_memory = 1;
  map(wanted);
  auto limited = cli::files_below(wanted.output);
  files.erase("run.json");
  limited.erase("run.json");
  EXPECT_EQ(files, limited);
}

/// A run with a scan that cannot be read and two whose ground does not fit the map.
class InterruptedMapRun : public MapRun {
 protected:
  InterruptedMapRun() {
    fs::create_directories(copy());
    fs::copy(run() / "velodyne", copy() / "velodyne", fs::copy_options::recursive);
    fs::copy_file(run() / "times.txt", copy() / "times.txt");
    fs::resize_file(copy() / "velodyne" / "000007.bin", 1001);
    std::vector<std::string> lines = pose_lines();
    for (const std::size_t scan : {9U, 10U}) {
      std::istringstream words(lines[scan]);
      std::vector<double> numbers(12);
      for (double& number : numbers) words >> number;
      numbers[11] += 0.4;
      lines[scan] = fmt::format("{:.9g}", fmt::join(numbers, " "));
    }
    put_poses(lines);
  }

  fs::path copy() const { return out / "copy"; }

  MapRequest request() const {
    MapRequest wanted = MapRun::request("map");
    wanted.run = copy();
    wanted.poses = out / "changed.txt";
    wanted.checkpoint_interval = 0;
    return wanted;
  }

  /// The files of a run that is mapped at once, by name.
  auto files_without_a_break(const MapRequest& request) {
    map(request);
    const auto files = cli::files_below(request.output);
    fs::remove_all(request.output);
    return files;
  }

  /// Maps until `scans` are mapped, then ends as if the process was killed.
  void map_until(const MapRequest& request, std::size_t scans) const {
    struct Killed {};
    const RunCallbacks callbacks{.progress = [&](const Progress& at) {
      if (at.unit == "scans mapped" && at.done == scans) throw Killed();
    }};
    EXPECT_THROW(map_run(request, {.run = callbacks}), Killed);
  }

  /// Maps, and returns how many scans were mapped before.
  std::size_t resume(const MapRequest& request) {
    std::vector<std::size_t> done;
    messages.clear();
    const RunCallbacks callbacks{
        .progress =
            [&](const Progress& at) {
              if (at.unit == "scans mapped") done.push_back(at.done);
            },
        .message = [&](const std::string& line) { messages.push_back(line); }};
    EXPECT_FALSE(map_run(request, {.run = callbacks}).interrupted);
    EXPECT_EQ(done.size(), frames - done.front() + 1);
    return done.front();
  }
};

TEST_F(InterruptedMapRun, IsResumedAtItsLastCheckpointWithIdenticalFiles) {
  for (const LabelSource labels : {LabelSource::live, LabelSource::delayed, LabelSource::offline}) {
    MapRequest wanted = request();
    wanted.labels = labels;
    wanted.delay = 0.5;
    wanted.map_memory = labels == LabelSource::live ? 1 : 1000;
    wanted.heights = true;
    map(wanted);
    EXPECT_THAT(messages, Contains(HasSubstr("000007.bin: byte 992")));
    EXPECT_THAT(messages,
                Contains(HasSubstr("000009.bin: the ground does not fit the map in this scan "
                                   "and later ones: 2 scans are labelled alone")));
    const auto expected = cli::files_below(wanted.output);
    for (const std::size_t scans : {std::size_t{1}, std::size_t{11}, frames}) {
      fs::remove_all(wanted.output);
      map_until(wanted, scans);
      EXPECT_NE(cli::files_below(wanted.output), expected);

      EXPECT_EQ(resume(wanted), scans);

      EXPECT_EQ(cli::files_below(wanted.output), expected) << scans;
      EXPECT_THAT(messages, Contains(HasSubstr(fmt::format("resumed: {} of 24", scans))));
    }
    fs::remove_all(wanted.output);
  }
}

TEST_F(InterruptedMapRun, CanBeInterruptedAgain) {
  MapRequest wanted = request();
  wanted.labels = LabelSource::delayed;
  wanted.delay = 0.5;
  const auto expected = files_without_a_break(wanted);
  for (const std::size_t scans : {3U, 4U, 9U, 20U}) map_until(wanted, scans);
  EXPECT_EQ(resume(wanted), 20U);
  EXPECT_EQ(cli::files_below(wanted.output), expected);
}

TEST_F(InterruptedMapRun, DoesNotReadTheScansBeforeTheCheckpointAgain) {
  MapRequest wanted = request();
  wanted.labels = LabelSource::live;
  wanted.voxel = 0;
  const auto expected = files_without_a_break(wanted);
  map_until(wanted, 6);
  for (int scan = 0; scan < 6; ++scan) {
    io::put_file(copy() / "velodyne" / fmt::format("{:06}.bin", scan), "");
  }
  EXPECT_EQ(resume(wanted), 6U);
  EXPECT_EQ(cli::files_below(wanted.output), expected);
}

TEST_F(InterruptedMapRun, UsesTheLastCompleteCheckpoint) {
  const MapRequest wanted = request();
  const auto expected = files_without_a_break(wanted);
  map_until(wanted, 8);
  // Killed while it wrote the next checkpoint.
  const fs::path state = wanted.output / "state";
  const fs::path next = state / (fs::exists(state / "0") ? "1" : "0");
  EXPECT_FALSE(fs::exists(next));
  fs::create_directories(next);
  io::put_file(next / "map.bin", "incomplete");
  EXPECT_EQ(resume(wanted), 8U);
  EXPECT_EQ(cli::files_below(wanted.output), expected);
}

TEST_F(InterruptedMapRun, WithADamagedCheckpointIsMappedAgain) {
  const MapRequest wanted = request();
  map(wanted);
  const auto expected = cli::files_below(wanted.output);
  for (const char* name : {"scans.bin", "map.bin", "votes.bin", "moving.bin"}) {
    fs::remove_all(wanted.output);
    map_until(wanted, 8);
    const fs::path state = wanted.output / "state";
    const fs::path file = state / (fs::exists(state / "0") ? "0" : "1") / name;
    fs::resize_file(file, fs::file_size(file) - 1);
    EXPECT_EQ(resume(wanted), 0U) << name;
    EXPECT_EQ(cli::files_below(wanted.output), expected) << name;
  }
}

TEST_F(InterruptedMapRun, WhoseOpenScansCannotBeReadIsMappedAgain) {
  const MapRequest wanted = request();
  map_until(wanted, 8);
  io::put_file(copy() / "velodyne" / "000003.bin", "");
  fs::resize_file(copy() / "velodyne" / "000003.bin", 3);
  EXPECT_EQ(resume(wanted), 0U);
  EXPECT_THAT(messages, Contains(HasSubstr("000003.bin: byte 0")));
}

TEST_F(InterruptedMapRun, ShortRunsWriteNoCheckpointWhileTheyAreMapped) {
  MapRequest wanted = request();
  wanted.checkpoint_interval = 60;
  map_until(wanted, 8);
  EXPECT_FALSE(fs::exists(wanted.output / "state" / "scans.json"));
}

TEST_F(MapRun, AnInterruptedRunIsResumedWithIdenticalFiles) {
  const MapRequest wanted = request("map");
  map(wanted);
  const auto expected = cli::files_below(wanted.output);
  for (const char* phase : {"scans mapped", "scans labelled"}) {
    fs::remove_all(wanted.output);
    bool stop = false;
    const MapOutcome interrupted = map_run(
        wanted, {.run = {.progress =
                             [&](const Progress& at) {
                               stop =
                                   stop || (at.unit == phase && at.done > 5 && at.done < at.total);
                             },
                         .stop = [&] { return stop; }}});
    if (!interrupted.interrupted) continue;  // labelling may be too fast to stop
    EXPECT_NE(cli::files_below(wanted.output), expected);
    std::map<std::string, std::size_t> first;
    const MapOutcome resumed = map_run(wanted, {.run = {.progress = [&](const Progress& at) {
                                                  first.try_emplace(std::string(at.unit), at.done);
                                                }}});
    EXPECT_FALSE(resumed.interrupted);
    if (std::string(phase) == "scans mapped") {
      EXPECT_GT(first.at("scans mapped"), 5U);
    } else {
      EXPECT_FALSE(first.contains("scans mapped"));
    }
    EXPECT_EQ(cli::files_below(wanted.output), expected) << phase;
  }
}

TEST_F(MapRun, ADamagedStateIsNotUsed) {
  const MapRequest wanted = request("map");
  map(wanted);
  const auto expected = cli::files_below(wanted.output);
  fs::create_directories(wanted.output / "state");
  for (const char* text : {"", "{}", "[1]", "{\"scans\": []}", "{\"scans\": 3"}) {
    io::put_file(wanted.output / "state" / "scans.json", text);
    map(wanted);
    EXPECT_EQ(cli::files_below(wanted.output), expected) << text;
    fs::create_directories(wanted.output / "state");
  }
}

TEST_F(MapRun, LiveLabelsDependOnEarlierScansOnly) {
  MapRequest wanted = request("all");
  wanted.labels = LabelSource::live;
  map(wanted);
  const fs::path shorter = out / "shorter";
  fs::create_directories(shorter / "velodyne");
  for (std::size_t scan = 0; scan < 10; ++scan) {
    const std::string name = fmt::format("{:06}.bin", scan);
    fs::copy_file(run() / "velodyne" / name, shorter / "velodyne" / name);
  }
  fs::copy_file(run() / "times.txt", shorter / "times.txt");
  MapRequest of_shorter = request("first");
  of_shorter.run = shorter;
  of_shorter.labels = LabelSource::live;
  map(of_shorter);
  for (std::size_t scan = 0; scan < 10; ++scan) {
    EXPECT_EQ(codes(of_shorter, scan), codes(wanted, scan)) << scan;
  }
}

TEST_F(MapRun, DelayedLabelsDependOnTheScansOfTheDelay) {
  MapRequest live = request("live");
  live.labels = LabelSource::live;
  map(live);
  MapRequest delayed = request("delayed");
  delayed.labels = LabelSource::delayed;
  delayed.delay = 0;
  map(delayed);
  EXPECT_EQ(codes(delayed, 5), codes(live, 5));
  MapRequest later = request("later");
  later.labels = LabelSource::delayed;
  later.delay = 1;
  map(later);
  EXPECT_NE(codes(later, 5), codes(live, 5));
}

TEST_F(MapRun, AScanThatCannotBeReadIsReportedOnOneLine) {
  const fs::path copy = out / "copy";
  fs::create_directories(copy);
  fs::copy(run() / "velodyne", copy / "velodyne", fs::copy_options::recursive);
  fs::copy_file(run() / "times.txt", copy / "times.txt");
  fs::resize_file(copy / "velodyne" / "000007.bin", 1001);
  MapRequest wanted = request("map");
  wanted.run = copy;
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.failed, 1U);
  EXPECT_EQ(outcome.mapped, frames - 1);
  EXPECT_THAT(messages, Contains(HasSubstr("000007.bin: byte 992")));
  EXPECT_FALSE(fs::exists(wanted.output / "labels" / "000007.label"));
  EXPECT_TRUE(fs::exists(wanted.output / "labels" / "000008.label"));
}

TEST_F(MapRun, AScanWithoutAPoseIsLabelledAlone) {
  std::vector<std::string> lines = pose_lines();
  lines[4] = "nan nan nan nan nan nan nan nan nan nan nan nan";
  MapRequest wanted = request("map");
  wanted.poses = put_poses(lines);
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.alone, 1U);
  EXPECT_EQ(outcome.mapped, frames - 1);
  EXPECT_THAT(messages, Contains(HasSubstr("line 5 is not finite")));
  EXPECT_EQ(codes(wanted, 4), own_labels(4));
}

TEST_F(MapRun, TimesThatDoNotIncreaseAreNotUsed) {
  const fs::path copy = out / "copy";
  fs::create_directories(copy);
  fs::copy(run() / "velodyne", copy / "velodyne", fs::copy_options::recursive);
  std::string times;
  for (std::size_t scan = 0; scan < frames; ++scan) times += "1.5\n";
  io::put_file(copy / "times.txt", times);
  MapRequest wanted = request("map");
  wanted.run = copy;
  EXPECT_EQ(map(wanted).mapped, frames);
  EXPECT_THAT(messages, Contains(HasSubstr("do not increase: 10 scans per second are assumed")));
}

TEST_F(MapRun, FewerPosesThanScansLeaveTheLastScansAlone) {
  std::vector<std::string> lines = pose_lines();
  lines.resize(20);
  MapRequest wanted = request("map");
  wanted.poses = put_poses(lines);
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.alone, frames - 20);
  EXPECT_THAT(messages, Contains(HasSubstr("without a pose")));
  EXPECT_EQ(codes(wanted, frames - 1), own_labels(frames - 1));
}

TEST_F(MapRun, AJumpOfThePosesSplitsTheRunAndTheLongestPartIsMapped) {
  std::vector<std::string> lines = pose_lines();
  for (std::size_t scan = 16; scan < frames; ++scan) {
    std::istringstream words(lines[scan]);
    std::vector<double> numbers(12);
    for (double& number : numbers) words >> number;
    numbers[7] += 5;
    lines[scan] = fmt::format("{:.9g}", fmt::join(numbers, " "));
  }
  MapRequest wanted = request("map");
  wanted.poses = put_poses(lines);
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.mapped, 16U);
  EXPECT_EQ(outcome.alone, frames - 16);
  EXPECT_THAT(messages, Contains(HasSubstr("jumps")));
  EXPECT_THAT(messages, Contains(HasSubstr("the longest one, 16 scans, is mapped")));
  EXPECT_EQ(codes(wanted, 20), own_labels(20));
}

TEST_F(MapRun, WithoutAnyUsablePoseEveryScanIsLabelledAlone) {
  MapRequest wanted = request("map");
  wanted.poses = put_poses(
      std::vector<std::string>(frames, "nan nan nan nan nan nan nan nan nan nan nan nan"));
  const MapOutcome outcome = map(wanted);
  EXPECT_EQ(outcome.alone, frames);
  EXPECT_THAT(messages, Contains(HasSubstr("no pose is usable")));
  for (const std::size_t scan : {std::size_t{0}, frames - 1}) {
    EXPECT_EQ(codes(wanted, scan), own_labels(scan));
  }
}

TEST_F(MapRun, OtherFilesAndOtherRequestsAreNotOverwritten) {
  MapRequest wanted = request("map");
  fs::create_directories(wanted.output);
  io::put_file(wanted.output / "notes.txt", "mine");
  EXPECT_THROW(map(wanted), std::invalid_argument);
  fs::remove(wanted.output / "notes.txt");
  map(wanted);
  const auto files = cli::files_below(wanted.output);
  wanted.voxel = 0.5;
  EXPECT_THROW(map(wanted), std::invalid_argument);
  EXPECT_EQ(cli::files_below(wanted.output), files);
  MapRequest into_run = request("map");
  into_run.output = run();
  EXPECT_THROW(map(into_run), std::invalid_argument);
}

TEST_F(MapRun, InvalidRequestsAreRejected) {
  const auto is_rejected = [&](const MapRequest& wanted, const char* option) {
    try {
      map(wanted);
      ADD_FAILURE() << option;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(option));
    }
    EXPECT_FALSE(fs::exists(wanted.output));
  };
  MapRequest wanted = request("map");
  wanted.delay = 11;
  is_rejected(wanted, "--delay");
  wanted = request("map");
  wanted.rate = 0;
  is_rejected(wanted, "--rate");
  wanted = request("map");
  wanted.voxel = -1;
  is_rejected(wanted, "--voxel");
  wanted = request("map");
  config::MethodChoice choice;
  choice.methods = {"patchwork"};
  wanted.method = config::resolve_one(choice);
  is_rejected(wanted, "--method");
  wanted = request("map");
  wanted.poses = out / "missing.txt";
  EXPECT_THROW(map(wanted), std::runtime_error);
}

}  // namespace
}  // namespace flagstone::app
