// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/labelled_scans.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/npy.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr std::size_t points = 3000;

/// A directory with velodyne/ and labels/ of two scans, in which every tenth point moves.
class EvalMoving : public testing::Test {
 protected:
  EvalMoving() {
    for (const std::string name : {"a", "b"}) put_moving_scan("run", name);
  }

  void put_moving_scan(const std::string& folder, const std::string& name) const {
    const io::Cloud scan = small_scan(points, static_cast<std::uint32_t>(name.back()));
    put_labelled(folder_ / folder, name, scan);
    std::vector<std::uint32_t> classes = made_up_classes(scan);
    for (std::size_t i = 0; i < points; i += 10) classes[i] = 252;
    const Status status =
        io::write_class_file(folder_ / folder / "labels" / (name + ".label"), classes);
    ASSERT_TRUE(status.ok()) << status.message();
  }

  /// Writes one object number per point: 3 for points below `end` that move, otherwise 0.
  void put_marks(const std::string& file, std::size_t end = points) const {
    std::vector<std::uint16_t> numbers(points);
    for (std::size_t i = 0; i < end; i += 10) numbers[i] = 3;
    std::string npy = io::npy_header(io::FieldType::uint16, points);
    npy.append(reinterpret_cast<const char*>(numbers.data()), 2 * points);
    fs::create_directories((folder_ / file).parent_path());
    io::put_file(folder_ / file, npy);
  }

  /// The output of `flagstone map`: moving points and labels, all of them ground.
  void put_mapped_run(const std::string& folder) const {
    fs::create_directories(folder_ / folder / "labels");
    io::put_file(folder_ / folder / "run.json", "{}");
    for (const std::string name : {"a", "b"}) {
      put_marks(folder + "/moving/" + name + ".moving.npy");
      const Status status =
          io::write_label_file(folder_ / folder / "labels" / (name + ".label"),
                               std::vector<Label>(points, Label::ground), io::LabelMap::flagstone);
      ASSERT_TRUE(status.ok()) << status.message();
    }
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  [[nodiscard]] Outcome eval(const std::vector<std::string>& more,
                             const std::string& dataset = "run") const {
    std::vector<std::string> arguments = {"eval", path(dataset), "--json", path("results.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// The moving points in the results file; expects success.
  [[nodiscard]] json moving(const std::string& folder, const std::string& dataset = "run") const {
    const Outcome outcome = eval({"--methods", "none", "--moving", "map=" + path(folder)}, dataset);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json_of(folder_ / "results.json")["moving"][0];
  }

  io::TemporaryFolder folder_;
};

TEST_F(EvalMoving, ScoresTheMovingPointsOfAMappedRun) {
  put_mapped_run("map");
  put_marks("map/moving/b.moving.npy", points / 2);

  const json found = moving("map");

  EXPECT_EQ(found["name"], "map");
  EXPECT_EQ(found["scans"], 2);
  EXPECT_EQ(found["precision"], 1);
  EXPECT_EQ(found["kept"], 1);
  ASSERT_THAT(found["per_scan"], SizeIs(2));
  const double first = found["per_scan"][0]["moving_points"];
  const double second = found["per_scan"][1]["moving_points"];
  EXPECT_GT(first, 100);
  EXPECT_LE(first, 300) << "points beyond 80 m are not scored";
  EXPECT_EQ(found["moving_points"], first + second);
  EXPECT_EQ(found["per_scan"][0]["iou"], 1);
  const double marked = found["per_scan"][1]["marked_points"];
  EXPECT_EQ(found["per_scan"][1]["recall"], marked / second);
  EXPECT_EQ(found["recall"], (first + marked) / (first + second));
  EXPECT_EQ(found["mean_iou"]["mean"], (1 + marked / second) / 2);
}

TEST_F(EvalMoving, OtherProgramsCanWriteArraysOrClasses) {
  put_mapped_run("map");
  const json expected = moving("map");
  for (const std::string name : {"a", "b"}) {
    put_marks("arrays/" + name + ".npy");
    put_marks("bare/" + name + ".moving.npy");
    std::vector<std::uint32_t> classes(points, 9);
    for (std::size_t i = 0; i < points; i += 10) classes[i] = 251;
    fs::create_directories(folder_ / "classes");
    ASSERT_TRUE(io::write_class_file(folder_ / ("classes/" + name + ".label"), classes).ok());
  }

  for (const char* folder : {"arrays", "bare", "classes"}) {
    EXPECT_EQ(moving(folder), expected) << folder;
  }
}

TEST_F(EvalMoving, AMappedRunFitsTheOnlySequenceOfATree) {
  put_mapped_run("map");
  const json expected = moving("map");
  fs::create_directories(folder_ / "tree/sequences");
  fs::rename(folder_ / "run", folder_ / "tree/sequences/05");

  const json found = moving("map", "tree");

  EXPECT_EQ(found["by_range"], expected["by_range"]);
  EXPECT_EQ(found["per_scan"][0]["scan"], "05/a");
}

TEST_F(EvalMoving, ATreeCanHaveAMappedRunPerSequence) {
  for (const std::string sequence : {"05", "06"}) {
    for (const std::string name : {"a", "b"}) put_moving_scan("tree/sequences/" + sequence, name);
    put_mapped_run("maps/" + sequence);
  }

  const json found = moving("maps", "tree");

  EXPECT_EQ(found["scans"], 4);
  EXPECT_EQ(found["iou"], 1);
}

TEST_F(EvalMoving, DoNotAffectTheResultsOfMethods) {
  put_mapped_run("map");
  ASSERT_EQ(eval({}).exit_code, 0);
  const json without = without_times(json_of(folder_ / "results.json"));
  EXPECT_FALSE(without.contains("moving"));

  ASSERT_EQ(eval({"--moving", "map=" + path("map")}).exit_code, 0);

  json with = without_times(json_of(folder_ / "results.json"));
  EXPECT_EQ(with.erase("moving"), 1U);
  EXPECT_EQ(with, without);
}

TEST_F(EvalMoving, PrintsATableAndWritesAReport) {
  put_mapped_run("map");

  const Outcome outcome = eval({"--methods", "none", "--moving", "map=" + path("map"), "--html",
                                path("report.html"), "--csv", path("results.csv")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Moving points of 2 scans of run"),
                                 ContainsRegex("\nmap +all +100.00 +100.00 +100.00 +100.00"),
                                 Not(HasSubstr("F1"))));
  EXPECT_THAT(io::contents_of(folder_ / "report.html"),
              AllOf(HasSubstr("<h2>Moving points</h2>"), HasSubstr("map, 0–10 m"),
                    Not(HasSubstr("<h2>Methods</h2>"))));
  EXPECT_THAT(io::contents_of(folder_ / "results.csv"), StartsWith("method,scan,"));
}

TEST_F(EvalMoving, AMissingFileIsReportedOnOneLineWithTheExpectedFile) {
  put_mapped_run("map");
  fs::remove(folder_ / "map/moving/b.moving.npy");

  const Outcome outcome = eval({"--methods", "none", "--moving", "map=" + path("map")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("b.bin: moving points map: "),
                                 HasSubstr("map/moving/b.moving.npy")));
  EXPECT_THAT(outcome.out, HasSubstr("map: scored on 1 of 2 scans"));
  const json results = json_of(folder_ / "results.json");
  EXPECT_EQ(results["moving"][0]["scans"], 1);
  EXPECT_EQ(results["failed"][0]["scan"], "b");
}

TEST_F(EvalMoving, AFileOfAnotherScanIsReportedOnOneLine) {
  put_mapped_run("map");
  io::put_file(folder_ / "map/moving/a.moving.npy",
               io::npy_header(io::FieldType::uint16, 1) + std::string(2, '\0'));

  const Outcome outcome = eval({"--methods", "none", "--moving", "map=" + path("map")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("a.moving.npy"), HasSubstr("3000 points")));
}

TEST_F(EvalMoving, ReportsUsageErrorsOnOneLine) {
  put_mapped_run("map");
  const std::string map = path("map");
  put_lidarseg(folder_ / "nuscenes", "n1", small_scan(200));
  const std::vector<std::pair<std::vector<std::string>, std::string>> misuses = {
      {{"--moving", "map"}, "--moving map: is not NAME=DIR"},
      {{"--moving", "map=" + path("gone")}, "gone is not a directory"},
      {{"--moving", "map=" + map, "--moving", "map=" + map},
       "map: two directories of moving points have this name"},
  };
  for (const auto& [arguments, message] : misuses) {
    const Outcome outcome = eval(arguments);

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, is_one_line_with(message));
  }
  const Outcome nuscenes = eval({"--protocol", "lidarseg", "--moving", "map=" + map}, "nuscenes");
  EXPECT_EQ(nuscenes.exit_code, 2);
  EXPECT_THAT(nuscenes.err,
              is_one_line_with("moving points cannot be scored with nuScenes-lidarseg ids"));
}

TEST_F(EvalMoving, LabelsOfAMappedRunAreScoredLikeAMethod) {
  put_mapped_run("map");

  for (const char* label_map : {"flagstone", "semantic-kitti"}) {
    const Outcome outcome =
        eval({"--methods", "none", "--labels", "map=" + path("map"), "--label-map", label_map});

    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json results = json_of(folder_ / "results.json");
    EXPECT_EQ(results["methods"][0]["recall"]["mean"], 1) << "codes of flagstone";
    EXPECT_LT(results["methods"][0]["precision"]["mean"], 1);
  }
}

TEST_F(EvalMoving, HeightsOfAMappedRunAndOfAMethodAreScoredAtTheSamePoints) {
  put_mapped_run("map");
  fs::create_directories(folder_ / "run/ground");
  fs::create_directories(folder_ / "map/heights");
  for (const std::string name : {"a", "b"}) {
    const std::array shape = {points};
    const io::Cloud scan = scan_of(folder_ / ("run/velodyne/" + name + ".bin"));
    std::vector<float> heights(points);  // 2 cm too high at every second point
    for (std::size_t i = 0; i < points; ++i) {
      heights[i] = i % 2 == 0 ? scan.view()[i].z + 1.7F + 0.02F : std::nanf("");
    }
    ASSERT_TRUE(io::write_npy_file(folder_ / ("run/ground/" + name + ".ground.npy"),
                                   std::vector<float>(points, -1.7F), shape)
                    .ok());
    ASSERT_TRUE(
        io::write_npy_file(folder_ / ("map/heights/" + name + ".heights.npy"), heights, shape)
            .ok());
  }

  const Outcome outcome = eval({"--methods", "surface", "--labels", "map=" + path("map"), "--csv",
                                path("results.csv"), "--html", path("report.html")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json results = json_of(folder_ / "results.json");
  const json surface = results["methods"][0]["heights"];
  const json map = results["methods"][1]["heights"];
  EXPECT_NEAR(map["ground"]["median"]["mean"], 0.02, 1e-5);
  EXPECT_LT(map["ground"]["with_height"], 0.7);
  for (const char* set : {"common_ground", "common_everywhere"}) {
    EXPECT_GT(map[set]["points"], 100) << set;
    EXPECT_EQ(map[set]["points"], surface[set]["points"]) << set;
    EXPECT_EQ(map[set]["with_height"], 1) << set;
    EXPECT_EQ(surface[set]["with_height"], 1) << set;
    EXPECT_NEAR(map[set]["median"]["mean"], 0.02, 1e-5) << set;
  }
  EXPECT_THAT(outcome.out, HasSubstr("for which every method provides a height"));
  EXPECT_THAT(io::contents_of(folder_ / "results.csv"), HasSubstr(",height_common_median_0_20m"));
  EXPECT_THAT(io::contents_of(folder_ / "report.html"),
              HasSubstr("for which every method provides a height"));

  fs::remove(folder_ / "map/heights/b.heights.npy");
  const Outcome incomplete = eval({"--methods", "none", "--labels", "map=" + path("map")});
  EXPECT_EQ(incomplete.exit_code, 1);
  EXPECT_THAT(incomplete.err, is_one_line_with("map/heights/b.heights.npy"));
}

TEST_F(EvalMoving, AMissingLabelFileOfAMappedRunIsNamed) {
  put_mapped_run("map");
  fs::remove(folder_ / "map/labels/a.label");

  const Outcome outcome = eval({"--methods", "none", "--labels", "map=" + path("map")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("map/labels/a.label"));
}

}  // namespace
}  // namespace flagstone::cli
