// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
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
#include "flagstone/surface.hpp"
#include "real_scans.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

constexpr double tiny = 1e-9;

/// Points, or fractions of cells, by the outcome of the comparison.
struct Counts {
  double tp = 0, fp = 0, fn = 0, tn = 0;

  void add(bool found, bool is, double weight = 1) {
    (found ? (is ? tp : fp) : (is ? fn : tn)) += weight;
  }
  [[nodiscard]] double precision() const { return tp / (tp + fp); }
  [[nodiscard]] double recall() const { return tp / (tp + fn); }
  [[nodiscard]] double f1() const { return 2 * precision() * recall() / (precision() + recall()); }
  [[nodiscard]] double accuracy() const { return (tp + tn) / (tp + fp + fn + tn); }
  [[nodiscard]] double iou() const { return tp / (tp + fp + fn); }
};

/// Counts of a scan under the protocol of the paper, computed independently from the labels of the
/// library.
struct Expected {
  Counts points;
  std::array<Counts, 4> by_range;
  Counts by_area;

  explicit Expected(const io::Cloud& scan) {
    const std::vector<Label> labels = labels_of(scan);
    const auto classes = made_up_classes(scan);
    std::map<std::pair<double, double>, Counts> cells;
    for (std::size_t i = 0; i < scan.size(); ++i) {
      const Point p = scan.view()[i];
      const bool found = labels[i] == Label::ground;
      const bool is = classes[i] == 40 || (classes[i] == 70 && p.z < -1.3f);
      points.add(found, is);
      const double range = std::hypot(p.x, p.y);
      const std::array ends = {10.0, 20.0, 40.0, 80.0};
      const auto band = std::ranges::upper_bound(ends, range) - ends.begin();
      if (band < 4) by_range[static_cast<std::size_t>(band)].add(found, is);
      if (std::abs(p.x) < 80 && std::abs(p.y) < 80) {
        cells[{std::floor(p.x / 0.5), std::floor(p.y / 0.5)}].add(found, is);
      }
    }
    for (const auto& [place, cell] : cells) {
      const double all = cell.tp + cell.fp + cell.fn + cell.tn;
      by_area.tp += cell.tp / all;
      by_area.fp += cell.fp / all;
      by_area.fn += cell.fn / all;
      by_area.tn += cell.tn / all;
    }
  }
};

/// A directory with velodyne/ and labels/ of three scans, for the files of a test.
class EvalCommand : public testing::Test {
 protected:
  EvalCommand() {
    for (const std::string name : {"a", "b", "c"}) {
      put_labelled(folder_ / "kitti", name, scan(name));
    }
  }

  static io::Cloud scan(const std::string& name) {
    return small_scan(3000, static_cast<std::uint32_t>(name.back()));
  }

  /// Writes the true ground heights at the points of a scan.
  void put_ground(const std::string& name, const std::vector<float>& heights) const {
    fs::create_directories(folder_ / "kitti/ground");
    const Status status = io::write_npy_file(folder_ / "kitti/ground" / (name + ".ground.npy"),
                                             heights, std::array{heights.size()});
    ASSERT_TRUE(status.ok()) << status.message();
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// `flagstone eval DATASET --json results.json` and more.
  [[nodiscard]] Outcome eval(const std::string& dataset,
                             const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"eval", path(dataset), "--json", path("results.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  /// The results file; expects success.
  [[nodiscard]] json results(const std::string& dataset,
                             const std::vector<std::string>& more = {}) const {
    const Outcome outcome = eval(dataset, more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return json_of(folder_ / "results.json");
  }

  /// The results of a method without its name, titles and times.
  static json figures_of(const json& results, std::size_t method) {
    json figures = without_times(results)["methods"][method];
    figures.erase("name");
    figures.erase("title");
    return figures;
  }

  static std::vector<std::string> scans_of(const json& results) {
    std::vector<std::string> names;
    for (const json& scan : results["methods"][0]["per_scan"]) names.push_back(scan["scan"]);
    return names;
  }

  io::TemporaryFolder folder_;
};

TEST_F(EvalCommand, JsonMatchesIndependentCounts) {
  const std::vector<Expected> expected = {Expected(scan("a")), Expected(scan("b")),
                                          Expected(scan("c"))};

  const json results = this->results("kitti");

  EXPECT_EQ(results["protocol"], "patchwork");
  EXPECT_EQ(results["scans"], 3);
  EXPECT_EQ(results["datasets"], json::array({"kitti"}));
  EXPECT_EQ(results["failed"], json::array());
  ASSERT_THAT(results["methods"], SizeIs(2));
  const json& method = results["methods"][0];
  EXPECT_EQ(method["name"], "surface");
  EXPECT_EQ(results["methods"][1]["name"], "patchwork") << "to compare with";
  EXPECT_GT(method["hz"].get<double>(), 0);
  EXPECT_LE(method["hz_slowest_1_percent"].get<double>(), method["hz"].get<double>());

  const std::array<std::pair<const char*, double (Counts::*)() const>, 5> figures = {
      {{"precision", &Counts::precision},
       {"recall", &Counts::recall},
       {"f1", &Counts::f1},
       {"accuracy", &Counts::accuracy},
       {"iou", &Counts::iou}}};
  for (const auto& [name, figure] : figures) {
    double mean = 0;
    for (const Expected& scan : expected) mean += (scan.points.*figure)() / 3;
    double squares = 0;
    for (const Expected& scan : expected) {
      squares += ((scan.points.*figure)() - mean) * ((scan.points.*figure)() - mean);
    }
    const double deviation = std::sqrt(squares / 2);
    EXPECT_NEAR(method[name]["mean"], mean, tiny) << name;
    EXPECT_NEAR(method[name]["std"], deviation, tiny) << name;
    // Student's t for 2 degrees of freedom
    EXPECT_NEAR(method[name]["ci95"], 4.303 * deviation / std::sqrt(3.0), tiny) << name;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(method["per_scan"][i][name], (expected[i].points.*figure)(), tiny) << name;
    }

    Counts pooled;
    Counts area;
    const auto sum = [](Counts& all, const Counts& one) {
      all = {all.tp + one.tp, all.fp + one.fp, all.fn + one.fn, all.tn + one.tn};
    };
    for (const Expected& scan : expected) {
      sum(pooled, scan.points);
      sum(area, scan.by_area);
    }
    EXPECT_NEAR(method["pooled"][name], (pooled.*figure)(), tiny) << name;
    EXPECT_NEAR(method["by_area"][name], (area.*figure)(), 1e-6) << name;  // shares are floats
    ASSERT_THAT(method["by_range"], SizeIs(4));
    for (std::size_t band = 0; band < 4; ++band) {
      Counts in_band;
      for (const Expected& scan : expected) sum(in_band, scan.by_range[band]);
      EXPECT_NEAR(method["by_range"][band][name], (in_band.*figure)(), tiny) << name << band;
    }
  }
  EXPECT_EQ(method["pooled"]["points"], 9000);
  EXPECT_EQ(method["by_range"][1]["from"], 10);
  EXPECT_EQ(method["by_range"][1]["to"], 20);
}

TEST_F(EvalCommand, TrueHeightsDoNotAffectMethodsWithoutHeights) {
  const std::vector<std::string> patchwork = {"--methods", "patchwork"};
  const json before = without_times(results("kitti", patchwork));
  for (const std::string name : {"a", "b", "c"}) {
    put_ground(name, std::vector<float>(scan(name).size(), -1.7F));
  }

  EXPECT_EQ(without_times(results("kitti", patchwork)), before);
}

TEST_F(EvalCommand, ReportsTrueHeightsOfAnotherScanOnOneLine) {
  put_ground("b", std::vector<float>(7));

  const Outcome outcome = eval("kitti");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("ground/b.ground.npy"), HasSubstr("7 heights"),
                                 HasSubstr("3000 points")));
  EXPECT_EQ(json_of(folder_ / "results.json")["scans"], 2);
}

/// Height errors, computed independently from the heights of the library.
TEST_F(EvalCommand, EvaluatesHeightsIfTheTrueGroundIsKnown) {
  const io::Cloud cloud = scan("a");
  std::vector<float> ground;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ground.push_back(i % 10 == 0 ? std::nanf("") : -1.7F + 0.001F * static_cast<float>(i % 7));
  }
  put_ground("a", ground);
  Surface segmenter;
  Segmentation segmented;
  ASSERT_TRUE(segmenter.segment(cloud.view(), segmented).ok());
  const auto classes = made_up_classes(cloud);
  std::vector<double> near;
  double sum = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point p = cloud.view()[i];
    if (classes[i] != 40 || std::isnan(ground[i]) || std::hypot(p.x, p.y) >= 20) continue;
    ++points;
    const double error = segmented.heights()[i] - (static_cast<double>(p.z) - ground[i]);
    if (std::isnan(error)) continue;
    near.push_back(std::abs(error));
    sum += error;
  }
  ASSERT_GT(near.size(), 100U);
  std::ranges::sort(near);

  const json results = this->results(
      "kitti", {"--methods", "surface,patchwork", "--protocol", "simulation", "--every", "3"});

  const json& band = results["methods"][0]["heights"]["ground"]["by_range"][0];
  EXPECT_EQ(band["points"], points);
  EXPECT_NEAR(band["with_height"], static_cast<double>(near.size()) / static_cast<double>(points),
              tiny);
  EXPECT_NEAR(band["median"]["mean"], near[(near.size() + 1) / 2 - 1], tiny);
  EXPECT_NEAR(band["percentile95"]["mean"], near[(near.size() * 95 + 99) / 100 - 1], tiny);
  EXPECT_NEAR(band["bias"]["mean"], sum / static_cast<double>(near.size()), tiny);
  EXPECT_FALSE(results["methods"][1].contains("heights")) << "patchwork has none";
}

TEST_F(EvalCommand, PrintsHeightTablesOnlyIfHeightsAreEvaluated) {
  put_ground("a", std::vector<float>(scan("a").size(), -1.7F));

  const Outcome judged = eval("kitti", {"--methods", "surface", "--every", "3"});
  const Outcome not_judged = eval("kitti", {"--methods", "patchwork", "--every", "3"});

  EXPECT_THAT(judged.out, AllOf(HasSubstr("Error of the height above the ground"),
                                HasSubstr("  0-20 m    95 %    bias  coverage")));
  EXPECT_THAT(not_judged.out, Not(HasSubstr("Error of the height")));
}

TEST_F(EvalCommand, OmitsDeviationAndIntervalForOneScan) {
  const json results = this->results("kitti", {"--every", "3"});

  EXPECT_EQ(results["scans"], 1);
  const json& f1 = results["methods"][0]["f1"];
  EXPECT_TRUE(f1["mean"].is_number());
  EXPECT_TRUE(f1["std"].is_null());
  EXPECT_TRUE(f1["ci95"].is_null());
}

TEST_F(EvalCommand, PrintsNineRowsForTable1AndMarksTheBest) {
  const Outcome outcome = eval("kitti", {"--methods", "table1"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, StartsWith("Protocol patchwork, 3 scans of kitti. Percentages, "));
  const std::vector<std::string> lines = lines_of(outcome.out);
  const auto heading =
      std::ranges::find_if(lines, [](const auto& line) { return line.starts_with("Method"); });
  ASSERT_GE(std::distance(heading, lines.end()), 10);
  for (const char* column : {"precision", "std", "recall", "F1", "±95%", "IoU", "Hz"}) {
    EXPECT_THAT(*heading, HasSubstr(column));
  }
  std::vector<std::string> rows(heading + 1, heading + 10);
  const std::array titles = {"RANSAC ",    "GPF ",     "LineFit ",     "CascadedSeg ",   "R-GPF ",
                             "R-GPF + U ", "CZM + U ", "CZM + U + E ", "CZM + U + E + F"};
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_THAT(rows[i], StartsWith(titles[i]));
  // Seven columns and two deviations have a best one; output that is not a terminal has no bold.
  std::string table;
  for (const std::string& row : rows) table += row;
  EXPECT_GE(std::ranges::count(table, '*'), 9);
  EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(outcome.out, HasSubstr("Lowest F1"));
  EXPECT_THAT(outcome.out, ContainsRegex("time: reading [0-9]+ %, segmenting [0-9]+ %, scoring"));
}

TEST_F(EvalCommand, SelectsSequencesAndEveryNthScan) {
  for (const std::string name : {"000000", "000001", "000002", "000003"}) {
    put_labelled(folder_ / "tree/sequences/04", name, small_scan(200));
    put_labelled(folder_ / "tree/sequences/05", name, small_scan(200));
    put_labelled(folder_ / "tree/sequences/10", name, small_scan(200));
  }

  const json all = results("tree");
  const json picked = results("tree", {"--sequences", "05,10", "--every", "3"});

  EXPECT_EQ(all["scans"], 12);
  EXPECT_THAT(scans_of(picked), ElementsAre("05/000000", "05/000003", "10/000000", "10/000003"));
}

TEST_F(EvalCommand, ScoresNuScenesFilesUnderTheLidarsegProtocol) {
  put_lidarseg(folder_ / "nuscenes", "n1", scan("a"));
  Counts counts;
  const std::vector<Label> labels = labels_of(scan("a"));
  const auto classes = made_up_classes(scan("a"));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    counts.add(labels[i] == Label::ground, classes[i] == 40);
  }

  const json results = this->results("nuscenes", {"--protocol", "lidarseg"});

  EXPECT_EQ(results["protocol"], "lidarseg");
  EXPECT_THAT(scans_of(results), ElementsAre("n1"));
  EXPECT_NEAR(results["methods"][0]["f1"]["mean"], counts.f1(), tiny);
}

TEST_F(EvalCommand, ScoresSeveralDatasetsTogether) {
  put_labelled(folder_ / "other", "a", scan("a"));

  const json results = this->results("kitti", {path("other")});

  EXPECT_EQ(results["datasets"], json::array({"kitti", "other"}));
  EXPECT_THAT(scans_of(results), ElementsAre("kitti/a", "kitti/b", "kitti/c", "other/a"));
}

TEST_F(EvalCommand, RejectsAProtocolForOtherClassIds) {
  put_lidarseg(folder_ / "nuscenes", "n1", small_scan(200));

  const Outcome kitti = eval("kitti", {"--protocol", "lidarseg"});
  const Outcome nuscenes = eval("nuscenes", {"--protocol", "patchwork++"});

  EXPECT_EQ(kitti.exit_code, 2);
  EXPECT_THAT(kitti.err, is_one_line_with("(expected --protocol patchwork or patchwork++)"));
  EXPECT_EQ(nuscenes.exit_code, 2);
  EXPECT_THAT(nuscenes.err, is_one_line_with("(expected --protocol lidarseg)"));
  EXPECT_FALSE(fs::exists(folder_ / "results.json"));
}

TEST_F(EvalCommand, ReadsGroundClassesFromAProtocolFile) {
  io::put_file(folder_ / "low.toml",
               "ground = [40]\nignored = [0]\nlow_ground = [{id = 70, "
               "height = -1.5}]\n");
  io::put_file(folder_ / "classes.json",
               R"({"labels": "mine", "ground": [40], "ignored": [0, 70], "not_ground": [50]})");
  Counts low, classes_counts;
  const io::Cloud cloud = scan("a");
  const std::vector<Label> labels = labels_of(cloud);
  const auto classes = made_up_classes(cloud);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (classes[i] == 0) continue;
    const bool found = labels[i] == Label::ground;
    low.add(found, classes[i] == 40 || (classes[i] == 70 && cloud.view()[i].z < -1.5f));
    if (classes[i] != 70) classes_counts.add(found, classes[i] == 40);
  }

  const json by_toml = results("kitti", {"--protocol", path("low.toml"), "--every", "3"});
  const json by_json = results("kitti", {"--protocol", path("classes.json"), "--every", "3"});

  EXPECT_EQ(by_toml["protocol"], "low");
  EXPECT_NEAR(by_toml["methods"][0]["precision"]["mean"], low.precision(), tiny);
  EXPECT_NEAR(by_toml["methods"][0]["recall"]["mean"], low.recall(), tiny);
  EXPECT_EQ(by_json["protocol"], "classes");
  EXPECT_NEAR(by_json["methods"][0]["precision"]["mean"], classes_counts.precision(), tiny);
  EXPECT_NEAR(by_json["methods"][0]["recall"]["mean"], classes_counts.recall(), tiny);
}

TEST_F(EvalCommand, ReportsAnUnreadableScanOnOneLineAndContinues) {
  const json undisturbed = results("kitti", {"--methods", "patchwork,gpf"});
  io::put_file(folder_ / "kitti/velodyne/aa.bin", "17 bytes, no scan");
  io::put_file(folder_ / "kitti/labels/aa.label", "");

  const Outcome outcome = eval("kitti", {"--methods", "patchwork,gpf"});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("aa.bin"));
  json results = json_of(folder_ / "results.json");
  EXPECT_EQ(results["scans"], 3);
  ASSERT_THAT(results["failed"], SizeIs(1));
  EXPECT_EQ(results["failed"][0]["scan"], "aa");
  EXPECT_THAT(results["failed"][0]["error"].get<std::string>(), HasSubstr("aa.bin"));
  EXPECT_EQ(without_times(results)["methods"], without_times(undisturbed)["methods"]);
}

TEST_F(EvalCommand, WritesNoResultsWithoutAReadableScan) {
  for (const char* name : {"a", "b", "c"}) {
    io::put_file(folder_ / ("kitti/velodyne/" + std::string(name) + ".bin"), "no scan");
  }

  const Outcome outcome = eval("kitti");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(lines_of(outcome.err), AllOf(SizeIs(3), Each(StartsWith("flagstone: "))));
  EXPECT_FALSE(fs::exists(folder_ / "results.json"));
  EXPECT_FALSE(fs::exists(folder_ / "results.json.checkpoint"));
}

TEST_F(EvalCommand, WritesACsvRowPerMethodAndScan) {
  const json results =
      this->results("kitti", {"--methods", "patchwork,ransac", "--csv", path("results.csv")});

  const std::vector<std::string> lines = lines_of(io::contents_of(folder_ / "results.csv"));
  ASSERT_THAT(lines, SizeIs(1 + 2 * 3));
  EXPECT_THAT(lines[0], StartsWith("method,scan,precision,recall,f1,accuracy,iou,tp,fp,fn,tn,"));
  for (std::size_t row = 0; row < 6; ++row) {
    const json& method = results["methods"][row / 3];
    const json& scan = method["per_scan"][row % 3];
    std::vector<std::string> cells;
    std::string cell;
    for (std::istringstream line(lines[row + 1]); std::getline(line, cell, ',');) {
      cells.push_back(cell);
    }
    ASSERT_GE(cells.size(), 11U);
    EXPECT_EQ(cells[0], method["name"].get<std::string>());
    EXPECT_EQ(cells[1], scan["scan"].get<std::string>());
    EXPECT_NEAR(std::stod(cells[4]), scan["f1"], 1e-6);
    EXPECT_EQ(
        std::stoi(cells[7]) + std::stoi(cells[8]) + std::stoi(cells[9]) + std::stoi(cells[10]),
        3000);
  }
}

TEST_F(EvalCommand, WritesASelfContainedHtmlReport) {
  const Outcome outcome = run({"eval", path("kitti"), "--methods", "patchwork,gpf", "--html",
                               path("report.html"), "--images", "1", "--output", path("drawn")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder_ / "drawn"), SizeIs(1));
  EXPECT_THAT(outcome.out, HasSubstr("wrote " + path("report.html")));
  const std::string html = io::contents_of(folder_ / "report.html");
  const auto has = [&](const char* text) { return html.find(text) != std::string::npos; };
  EXPECT_TRUE(html.starts_with("<!doctype html>") && html.ends_with("</html>\n"));
  EXPECT_TRUE(has("<th scope=\"row\">Patchwork</th>"));
  EXPECT_TRUE(has("src=\"data:image/png;base64,"));
  // Attributes and rules that load; the plotting library's own comments may name its site.
  const std::regex loads(R"((src|href)\s*=\s*["']?\s*(https?:|//)|@import|url\()");
  EXPECT_FALSE(std::regex_search(html, loads));
}

TEST_F(EvalCommand, DrawsImagesOfTheWorstScans) {
  const Outcome outcome =
      eval("kitti", {"--methods", "patchwork,gpf", "--images", "2", "--output", path("drawn")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json results = json_of(folder_ / "results.json");
  std::vector<std::pair<double, std::string>> order;
  for (std::size_t i = 0; i < 3; ++i) {
    double f1 = 0;
    for (const json& method : results["methods"]) f1 += method["per_scan"][i]["f1"].get<double>();
    order.emplace_back(f1,
                       results["methods"][0]["per_scan"][i]["scan"].get<std::string>() + ".png");
  }
  std::ranges::sort(order);
  const auto pictures = files_below(folder_ / "drawn");
  ASSERT_THAT(pictures, SizeIs(2));
  for (const std::size_t i : {0U, 1U}) {
    ASSERT_TRUE(pictures.contains(order[i].second)) << order[i].second;
    EXPECT_THAT(pictures.at(order[i].second), StartsWith("\x89PNG\r\n\x1a\n"));
    EXPECT_THAT(outcome.out, HasSubstr("wrote " + path("drawn/" + order[i].second)));
  }
}

TEST_F(EvalCommand, CreatesTheDirectoriesOfResultFiles) {
  const Outcome outcome = run({"eval", path("kitti"), "--csv", path("new/deep/results.csv")});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder_ / "new"), ElementsAre("deep/results.csv"));
}

TEST_F(EvalCommand, ReportsAnUncreatableDirectoryBeforeTheRun) {
  io::put_file(folder_ / "taken", "mine");

  const Outcome outcome = run({"eval", path("kitti"), "--csv", path("taken/results.csv")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, is_one_line_with("taken: cannot be created"));
}

TEST_F(EvalCommand, ReportsUnwritableResultsBeforeTheRun) {
  const std::string file = path("results");
  const std::vector<std::pair<std::vector<std::string>, std::string>> misuses = {
      {{"--json", path("kitti")}, "kitti: is a directory"},
      {{"--json", file, "--csv", file}, "results"},
  };
  for (const auto& [arguments, said] : misuses) {
    std::vector<std::string> all = {"eval", path("kitti")};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run(all);

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, is_one_line_with(said));
  }
  EXPECT_EQ(folder_.entries(), 1);
}

TEST_F(EvalCommand, UnwritableResultsAreNotAUsageError) {
  const Outcome outcome = run({"eval", path("kitti"), "--json", "/proc/results.json"});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with("/proc/results.json"));
}

TEST_F(EvalCommand, RejectsAResultFileThatIsAnInput) {
  const auto before = files_below(folder_.path());
  for (const char* input : {"kitti/labels/a.label", "kitti/velodyne/b.bin"}) {
    for (const char* option : {"--json", "--csv", "--html"}) {
      const Outcome outcome = run({"eval", path("kitti"), option, path(input)});

      EXPECT_EQ(outcome.exit_code, 2) << option;
      EXPECT_THAT(outcome.err, is_one_line_with(path(input)));
    }
  }
  EXPECT_EQ(files_below(folder_.path()), before);
}

TEST_F(EvalCommand, ReportsAnUncreatableImageDirectoryBeforeTheRun) {
  io::put_file(folder_ / "taken", "mine");

  const Outcome outcome = eval("kitti", {"--images", "1", "--output", path("taken/drawn")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, is_one_line_with("taken/drawn: cannot be created"));
}

TEST_F(EvalCommand, PrintsSpeedNextToThePaperResults) {
  const Outcome outcome =
      eval("kitti", {"--methods", "patchwork,gpf,ransac", "--speed", "--threads", "2"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ContainsRegex("Method +mean +slowest 1% +paper"));
  EXPECT_THAT(outcome.out, ContainsRegex("Patchwork +[0-9.]+ +[0-9.]+ +43.97"));
  EXPECT_THAT(outcome.out, ContainsRegex("GPF +[0-9.]+ +[0-9.]+ +29.72"));
  EXPECT_THAT(outcome.out, ContainsRegex("RANSAC +[0-9.]+ +[0-9.]+ +- "));
  EXPECT_EQ(json_of(folder_ / "results.json")["threads"], 1);
}

TEST_F(EvalCommand, ResultsDoNotDependOnTheNumberOfThreads) {
  const json one = results("kitti", {"--methods", "all", "--threads", "1"});
  const json two = results("kitti", {"--methods", "all", "--threads", "2"});

  EXPECT_EQ(one["threads"], 1);
  EXPECT_EQ(two["threads"], 2);
  EXPECT_EQ(without_times(one), without_times(two));
}

/// Labels of `flagstone segment` get the same scores as the method itself.
class LabelsMadeElsewhere : public EvalCommand {
 protected:
  /// Labels of all three scans.
  void segment(const std::string& output, const std::string& label_map) const {
    const Outcome outcome = run({"segment", path("kitti/velodyne"), "--output", path(output),
                                 "--label-map", label_map, "--method", "gpf"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// Scores method 0, GPF itself, and method 1, its labels in a directory.
  [[nodiscard]] json both(const std::string& dataset, const std::string& labels,
                          const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"--methods", "gpf", "--labels", "other=" + path(labels)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    json found = results(dataset, arguments);
    EXPECT_EQ(found["methods"][1]["name"], "other");
    EXPECT_TRUE(found["methods"][1]["hz"].is_null());
    return found;
  }
};

TEST_F(LabelsMadeElsewhere, ScoreLikeTheMethodThatWroteThem) {
  for (const std::string label_map : {"flagstone", "semantic-kitti"}) {
    segment(label_map, label_map);

    const json found = both("kitti", label_map, {"--label-map", label_map});

    EXPECT_EQ(figures_of(found, 0), figures_of(found, 1)) << label_map;
  }
}

TEST_F(LabelsMadeElsewhere, CanBeNumPyArrays) {
  segment("made", "flagstone");
  for (const std::string name : {"a", "b", "c"}) {
    std::vector<Label> labels;
    for (const std::uint32_t code : codes_of(folder_ / ("made/" + name + ".label"))) {
      labels.push_back(static_cast<Label>(code));
    }
    fs::create_directories(folder_ / "arrays");
    ASSERT_TRUE(
        io::LabelWriter().write_label_npy(folder_ / ("arrays/" + name + ".npy"), labels).ok());
  }

  const json found = both("kitti", "arrays");

  EXPECT_EQ(figures_of(found, 0), figures_of(found, 1));
}

TEST_F(LabelsMadeElsewhere, CanHaveTheLayoutOfSemanticKittiPredictions) {
  segment("made", "semantic-kitti");
  fs::create_directories(folder_ / "tree/sequences");
  fs::rename(folder_ / "kitti", folder_ / "tree/sequences/08");
  fs::create_directories(folder_ / "submission/sequences/08");
  fs::rename(folder_ / "made", folder_ / "submission/sequences/08/predictions");

  const json found = both("tree", "submission", {"--label-map", "semantic-kitti"});

  EXPECT_EQ(figures_of(found, 0), figures_of(found, 1));
}

TEST_F(LabelsMadeElsewhere, CanBeTheOutputOfSegmentForTheWholeDataset) {
  put_labelled(folder_ / "tree/sequences/08", "000000", scan("a"));
  for (const std::string dataset : {"kitti", "tree"}) {
    for (const std::string format : {"label", "u8"}) {
      const std::string output = fmt::format("{}-of-{}", format, dataset);
      const Outcome outcome = run({"segment", path(dataset), "--output", path(output), "--method",
                                   "gpf", "--format", format});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;

      const json found = both(dataset, output);

      EXPECT_EQ(figures_of(found, 0), figures_of(found, 1)) << output;
    }
  }
}

TEST_F(LabelsMadeElsewhere, HaveOneDirectoryPerDataset) {
  for (const std::string dataset : {"one", "two"}) {
    put_labelled(folder_ / (dataset + "/sequences/08"), "000000", scan(dataset));
    const Outcome outcome =
        run({"segment", path(dataset), "--output", path("made/" + dataset), "--method", "gpf"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  const json found = both("one", "made", {path("two")});

  EXPECT_EQ(found["scans"], 2);
  EXPECT_EQ(figures_of(found, 0), figures_of(found, 1));
}

TEST_F(LabelsMadeElsewhere, HaveNoResultsIfAllAreMissing) {
  fs::create_directories(folder_ / "made");

  const Outcome outcome = eval("kitti", {"--methods", "gpf", "--labels", "other=" + path("made"),
                                         "--html", path("report.html")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(lines_of(outcome.err), SizeIs(3));
  EXPECT_THAT(outcome.out, ContainsRegex("\nother +- +- +- "));
  const json other = json_of(folder_ / "results.json")["methods"][1];
  for (const char* figure : {"precision", "recall", "f1", "accuracy", "iou"}) {
    EXPECT_TRUE(other[figure]["mean"].is_null()) << figure;
    EXPECT_TRUE(other["pooled"][figure].is_null()) << figure;
    EXPECT_TRUE(other["by_area"][figure].is_null()) << figure;
    EXPECT_TRUE(other["by_range"][0][figure].is_null()) << figure;
  }
  EXPECT_TRUE(fs::exists(folder_ / "report.html"));
}

TEST_F(LabelsMadeElsewhere, AreReportedOnOneLineIfMissingForAScan) {
  segment("made", "flagstone");
  fs::remove(folder_ / "made/b.label");

  const Outcome outcome = eval("kitti", {"--methods", "gpf", "--labels", "other=" + path("made"),
                                         "--images", "3", "--output", path("drawn")});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(is_one_line_with("method other"), HasSubstr("made/b.label")));
  const json found = json_of(folder_ / "results.json");
  EXPECT_THAT(found["methods"][0]["per_scan"], SizeIs(3));
  EXPECT_THAT(found["methods"][1]["per_scan"], SizeIs(2));
  EXPECT_EQ(found["failed"][0]["scan"], "b");
  EXPECT_THAT(names_below(folder_ / "drawn"), ElementsAre("a.png", "b.png", "c.png"));
}

TEST_F(EvalCommand, ReportsUsageErrorsOnOneLine) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> misuses = {
      {{"--methods", "magic"}, "no method is named 'magic'"},
      {{"--methods", "none"}, "no method to evaluate (set --methods, --labels or --moving)"},
      {{"--protocol", "kitti"}, "patchwork, patchwork++, lidarseg, simulation"},
      {{"--protocol", "nowhere.toml"}, "nowhere.toml"},
      {{"--sequences", "05"}, "has no sequences/"},
      {{"--every", "0"}, "--every"},
      {{"--threads", "0"}, "--threads"},
      {{"--labels", "other"}, "NAME=DIR"},
      {{"--set", "patchwork.seed_cuont=3"}, "no setting 'seed_cuont'"},
      {{"--set", "patchwork.distance_margin=-1"}, "distance_margin = -1"},
      {{"--set", "surface.distance_margin=1"},
       "no setting 'distance_margin' (method patchwork has it)"},
      {{"--methods", "surface", "--preset", "paper"}, "surface has no presets"},
      {{"--images", "-1"}, "--images"},
      {{"--label-map", "mine"}, "expected flagstone, semantic-kitti"},
      {{path("empty")}, "empty: not a dataset"},
      {{path("gone")}, "gone: no such directory"},
      {{path("kitti")}, "kitti/a: this scan is listed twice"},
  };
  fs::create_directories(folder_ / "empty");
  for (const auto& [arguments, said] : misuses) {
    const Outcome outcome = eval("kitti", arguments);

    EXPECT_EQ(outcome.exit_code, 2) << arguments[0];
    EXPECT_EQ(outcome.out, "") << arguments[0];
    EXPECT_THAT(outcome.err, is_one_line_with(said));
    EXPECT_FALSE(fs::exists(folder_ / "results.json"));
  }
}

TEST_F(EvalCommand, ScanWithoutTrueGroundCountsOnlyForAccuracy) {
  const json before = results("kitti", {"--methods", "surface"});
  put_scan(folder_ / "kitti/velodyne/d.bin", scan("d"));
  const Status status = io::write_class_file(folder_ / "kitti/labels/d.label",
                                             std::vector<std::uint32_t>(scan("d").size(), 50));
  ASSERT_TRUE(status.ok()) << status.message();

  const json after = results("kitti", {"--methods", "surface", "--csv", path("results.csv")});

  EXPECT_EQ(after["scans"], 4);
  EXPECT_EQ(after["without_ground"], 1);
  EXPECT_EQ(after["methods"][0]["recall"], before["methods"][0]["recall"]);
  EXPECT_EQ(after["methods"][0]["f1"], before["methods"][0]["f1"]);
  EXPECT_TRUE(after["methods"][0]["per_scan"][3]["f1"].is_null());
  EXPECT_THAT(io::contents_of(folder_ / "results.csv"), HasSubstr("surface,d,,,,"));
}

TEST(EvalOnRealScans, ScoresSequencesInTheOriginalLayoutUnderACustomProtocol) {
  const fs::path data = tests::real_scan_folder();
  if (!fs::exists(data / "sequences") || !fs::exists(data / "pandaset")) {
    GTEST_SKIP() << "no sequences in " << data;
  }
  const io::TemporaryFolder folder;
  const std::string file = (folder / "results.json").string();
  const auto mean_f1 = [&](const std::vector<std::string>& arguments, std::size_t scans) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json results = json_of(file);
    EXPECT_EQ(results["scans"], scans);
    return results["methods"][0]["f1"]["mean"].get<double>();
  };

  EXPECT_GT(mean_f1({"eval", data.string(), "--sequences", "00,05", "--every", "8", "--methods",
                     "surface", "--json", file},
                    4),
            0.9);
  EXPECT_GT(mean_f1({"eval", (data / "pandaset").string(), "--protocol",
                     (data / "pandaset/classes.json").string(), "--methods", "surface",
                     "--sensor-height", "2.1", "--json", file},
                    4),
            0.9);
  EXPECT_EQ(run({"sweep", (data / "sequences").string(), "--every", "10", "--method", "patchwork",
                 "--param", "distance_margin=0.1,0.15", "--csv", (folder / "sweep.csv").string()})
                .exit_code,
            0);
}

}  // namespace
}  // namespace flagstone::cli
