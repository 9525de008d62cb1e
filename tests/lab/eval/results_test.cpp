// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/eval/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lab/eval/results_export.hpp"
#include "lab/eval/results_text.hpp"

namespace flagstone::eval {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

MethodOutcome made(double hits, double misses, double ms) {
  MethodOutcome outcome;
  outcome.score.points = {.true_positives = hits, .false_negatives = misses};
  outcome.score.by_range[0] = outcome.score.points;
  outcome.score.by_area = outcome.score.points;
  outcome.segment_ms = ms;
  return outcome;
}

ScanOutcome outcome_of(std::vector<MethodOutcome> methods) {
  ScanOutcome outcome;
  outcome.methods = std::move(methods);
  return outcome;
}

/// Two methods on three scans. One scan could not be read, and the second method failed on another.
class ThreeScans : public testing::Test {
 protected:
  ThreeScans() {
    methods_[0].name = methods_[0].title = "first";
    methods_[1].name = methods_[1].title = "second";
    outcomes_[0] = outcome_of({made(90, 10, 1), made(50, 50, 4)});
    outcomes_[1] = ScanOutcome();
    outcomes_[1]->error = "b: unreadable";
    MethodOutcome failed;
    failed.error = "c: method second: out of memory";
    outcomes_[2] = outcome_of({made(70, 30, 3), failed});
    results_ = gather(methods_, scans_, outcomes_);
    results_.protocol = "patchwork";
    results_.datasets = {"synthetic"};
  }

  std::vector<Method> methods_{2};
  std::vector<LabelledScan> scans_ = {{"a", {}, {}}, {"b", {}, {}}, {"c,\"1\"", {}, {}}};
  std::vector<std::optional<ScanOutcome>> outcomes_{3};
  Results results_;
};

TEST_F(ThreeScans, MeansAreOverTheScansOfEachMethod) {
  EXPECT_EQ(results_.scans, 2u);
  EXPECT_DOUBLE_EQ(results_.methods[0].recall.mean, 0.8);
  EXPECT_NEAR(results_.methods[0].recall.std.value(), 0.1414, 1e-4);
  EXPECT_DOUBLE_EQ(results_.methods[1].recall.mean, 0.5);
  EXPECT_FALSE(results_.methods[1].recall.std);
}

TEST_F(ThreeScans, MicroAveragesAreOverPoints) {
  EXPECT_EQ(results_.methods[0].pooled.true_positives, 160);
  EXPECT_EQ(results_.methods[0].by_range[0].total(), 200);
}

TEST_F(ThreeScans, HzIsOneOverTheMeanTime) {
  EXPECT_DOUBLE_EQ(results_.methods[0].hz.value(), 500);
  EXPECT_DOUBLE_EQ(results_.methods[0].hz_slowest_1_percent.value(), 1000.0 / 3);
}

TEST_F(ThreeScans, FailuresAreListed) {
  ASSERT_EQ(results_.failures.size(), 2u);
  EXPECT_EQ(results_.failures[0].scan, "b");
  EXPECT_EQ(results_.failures[0].error, "b: unreadable");
}

TEST_F(ThreeScans, TheWorstScanComesFirst) {
  EXPECT_THAT(worst_scans(results_.methods[0], 5), ElementsAre(1, 0));
  EXPECT_THAT(worst_scans(results_.methods[0], 1), ElementsAre(1));
}

TEST_F(ThreeScans, JsonContainsTheDocumentedKeys) {
  const nlohmann::ordered_json json = to_json(results_);

  EXPECT_EQ(json["protocol"], "patchwork");
  EXPECT_EQ(json["scans"], 2);
  ASSERT_EQ(json["methods"].size(), 2u);
  const auto& first = json["methods"][0];
  EXPECT_EQ(first["name"], "first");
  for (const char* figure : {"precision", "recall", "f1", "accuracy", "iou"}) {
    for (const char* part : {"mean", "std", "ci95"}) {
      EXPECT_TRUE(first[figure][part].is_number()) << figure << '.' << part;
      EXPECT_EQ(json["methods"][1][figure]["std"].is_null(), true) << figure;
    }
    EXPECT_TRUE(first["pooled"][figure].is_number());
    EXPECT_TRUE(first["by_area"][figure].is_number());
  }
  ASSERT_EQ(first["by_range"].size(), 4u);
  EXPECT_EQ(first["by_range"][3]["from"], 40);
  EXPECT_EQ(first["by_range"][3]["to"], 80);
  EXPECT_EQ(first["hz"], 500);
  EXPECT_EQ(first["per_scan"].size(), 2u);
  EXPECT_EQ(json["failed"].size(), 2u);
}

TEST_F(ThreeScans, CsvHasARowPerMethodAndScanAndQuotesNames) {
  const std::string csv = to_csv(results_);

  EXPECT_THAT(csv, AllOf(HasSubstr("\r\nfirst,a,1.000000,0.900000,"),
                         HasSubstr("\r\nfirst,\"c,\"\"1\"\"\","), HasSubstr("\r\nsecond,a,"),
                         Not(HasSubstr("\r\nsecond,\"c"))));
}

TEST_F(ThreeScans, TheBestOfAColumnIsMarked) {
  EXPECT_THAT(accuracy_table(results_, {.bold = false}), HasSubstr("80.00*"));
  EXPECT_THAT(accuracy_table(results_, {.bold = true}),
              AllOf(HasSubstr("\x1b[1m"), HasSubstr("80.00\x1b[0m")));
}

TEST_F(ThreeScans, EveryMethodHasARowAndMissingValuesAreDashes) {
  const std::string table = accuracy_table(results_, {});

  EXPECT_THAT(table, AllOf(HasSubstr("\nfirst"), HasSubstr("\nsecond")));
  EXPECT_THAT(table.substr(table.find("second")), HasSubstr(" - "));
}

TEST_F(ThreeScans, AMethodThatMissesScansIsListedButNotCompared) {
  outcomes_[0]->methods[1] = made(99, 1, 4);  // better than the first, on one scan of two

  const Results results = gather(methods_, scans_, outcomes_);

  EXPECT_THAT(accuracy_table(results, {}), AllOf(HasSubstr("80.00*"), Not(HasSubstr("99.00*")),
                                                 HasSubstr("second: scored on 1 of 2 scans")));
}

TEST_F(ThreeScans, AScanWithoutScoredPointsIsExcluded) {
  outcomes_[2] = outcome_of({made(0, 0, 1), made(0, 0, 1)});

  const Results results = gather(methods_, scans_, outcomes_);

  EXPECT_EQ(results.scans, 1u);
  EXPECT_THAT(results.unscored, ElementsAre("c,\"1\""));
  EXPECT_DOUBLE_EQ(results.methods[0].f1.mean, made(90, 10, 1).score.points.f1());
}

MethodOutcome without_ground(double alarms, double rest) {
  MethodOutcome outcome;
  outcome.score.points = {.false_positives = alarms, .true_negatives = rest};
  return outcome;
}

TEST_F(ThreeScans, AScanWithoutGroundInTheGroundTruthCountsOnlyInTheAccuracy) {
  outcomes_[1] = outcome_of({without_ground(25, 75), without_ground(0, 100)});

  const Results results = gather(methods_, scans_, outcomes_);
  const nlohmann::ordered_json json = to_json(results);

  EXPECT_EQ(results.scans, 3u);
  EXPECT_EQ(results.without_ground, 1u);
  EXPECT_DOUBLE_EQ(results.methods[0].recall.mean, 0.8) << "the same as without that scan";
  EXPECT_DOUBLE_EQ(results.methods[0].f1.mean, results_.methods[0].f1.mean);
  EXPECT_EQ(results.methods[0].f1.count, 2u);
  EXPECT_DOUBLE_EQ(results.methods[0].accuracy.mean, (0.9 + 0.7 + 0.75) / 3);
  EXPECT_EQ(json["without_ground"], 1);
  EXPECT_EQ(json["methods"][0]["f1"]["scans"], 2);
  EXPECT_TRUE(json["methods"][0]["per_scan"][1]["f1"].is_null());
  EXPECT_EQ(json["methods"][0]["per_scan"][1]["accuracy"], 0.75);
  EXPECT_THAT(to_csv(results), HasSubstr("\r\nfirst,b,,,,0.750000,,0,25,0,75,"));
  EXPECT_THAT(accuracy_table(results, {}), HasSubstr("1 of 3 scans have no ground"));
  EXPECT_THAT(worst_scans(results.methods[0], 5), ElementsAre(2, 0));
}

TEST_F(ThreeScans, F1IsUndefinedWithoutGroundInAnyScan) {
  for (auto& outcome : outcomes_)
    outcome = outcome_of({without_ground(1, 9), without_ground(0, 9)});

  const Results results = gather(methods_, scans_, outcomes_);

  EXPECT_THAT(accuracy_table(results, {}), HasSubstr(" n/a "));
  EXPECT_TRUE(to_json(results)["methods"][0]["f1"]["mean"].is_null());
  EXPECT_THAT(worst_table(results, 3), Not(HasSubstr("(")));
}

HeightErrors errors(std::size_t given, double median, double bias) {
  return {.points = 4, .given = given, .median = median, .percentile95 = 2 * median, .bias = bias};
}

/// The first method has heights within 20 m on both scans, from 20 to 40 m only on the second, and
/// none beyond.
class ScansWithHeights : public ThreeScans {
 protected:
  ScansWithHeights() {
    HeightScore near;
    near.ground.by_range = {errors(4, 0.01, 0.002), errors(0, 0, 0), HeightErrors()};
    HeightScore far;
    far.ground.by_range = {errors(2, 0.03, -0.004), errors(3, 0.05, 0.01), HeightErrors()};
    far.everywhere.by_range[0] = errors(1, 0.2, 0);
    outcomes_[0]->methods[0].heights = near;
    outcomes_[2]->methods[0].heights = far;
    results_ = gather(methods_, scans_, outcomes_);
  }
};

TEST_F(ScansWithHeights, ErrorsAreMeansOverTheScansWithHeights) {
  ASSERT_TRUE(results_.methods[0].heights);
  const HeightFiguresByRange& ground = results_.methods[0].heights->ground;

  EXPECT_DOUBLE_EQ(ground.by_range[0].median.mean, 0.02);
  EXPECT_DOUBLE_EQ(ground.by_range[0].percentile95.mean, 0.04);
  EXPECT_DOUBLE_EQ(ground.by_range[0].bias.mean, -0.001);
  EXPECT_EQ(ground.by_range[0].median.count, 2U);
  EXPECT_DOUBLE_EQ(ground.by_range[1].median.mean, 0.05);
  EXPECT_EQ(ground.by_range[1].median.count, 1U);
  EXPECT_EQ(ground.by_range[2].median.count, 0U);
}

TEST_F(ScansWithHeights, CoverageIsOverThePointsOfAllScans) {
  const HeightFiguresByRange& ground = results_.methods[0].heights->ground;

  EXPECT_EQ(ground.by_range[0].share, 6.0 / 8);
  EXPECT_EQ(ground.by_range[1].share, 3.0 / 8);
  EXPECT_EQ(ground.by_range[2].share, std::nullopt);
}

TEST_F(ScansWithHeights, JsonContainsHeightsOfMethodsThatProvideThem) {
  const nlohmann::ordered_json json = to_json(results_);

  const auto& ground = json["methods"][0]["heights"]["ground"];
  ASSERT_EQ(ground["by_range"].size(), 3U);
  EXPECT_EQ(ground["by_range"][1]["from"], 20);
  EXPECT_EQ(ground["by_range"][1]["to"], 40);
  EXPECT_EQ(ground["by_range"][0]["median"]["mean"], 0.02);
  EXPECT_EQ(ground["by_range"][0]["percentile95"]["mean"], 0.04);
  EXPECT_EQ(ground["by_range"][0]["with_height"], 0.75);
  EXPECT_TRUE(ground["by_range"][2]["median"]["mean"].is_null());
  EXPECT_TRUE(ground["by_range"][2]["with_height"].is_null());
  const auto& scan = json["methods"][0]["per_scan"][1]["heights"];
  EXPECT_EQ(scan["ground"]["by_range"][0]["bias"], -0.004);
  EXPECT_EQ(scan["everywhere"]["by_range"][0]["median"], 0.2);
  EXPECT_FALSE(json["methods"][1].contains("heights"));
}

TEST_F(ScansWithHeights, CsvHasHeightsAfterAllOtherCells) {
  const std::string csv = to_csv(results_);

  EXPECT_THAT(csv, HasSubstr(",milliseconds,height_median_0_20m,height_percentile95_0_20m,"
                             "height_bias_0_20m,height_share_0_20m,height_median_20_40m,"));
  EXPECT_THAT(csv, HasSubstr(",0.010000,0.020000,0.002000,1.000000,,,,0.000000,,,,\r\n"));
  EXPECT_THAT(csv, HasSubstr("second,a,"));
  const std::string second = csv.substr(csv.find("second,a,"));
  EXPECT_THAT(second, testing::EndsWith(",4.0000,,,,,,,,,,,,\r\n"));
}

TEST_F(ScansWithHeights, TextIsInCentimetresWithDashesForMissingValues) {
  const std::string table = height_table(results_, &HeightResult::ground, {});

  EXPECT_THAT(table, AllOf(HasSubstr("0-20 m"), HasSubstr("20-40 m"), HasSubstr("40-80 m")));
  EXPECT_THAT(table.substr(table.find("first")),
              testing::MatchesRegex("first +2\\.00[ *]+4\\.00[ *]+-0\\.10[ *]+75\\.00[ *]+"
                                    "5\\.00[ *]+10\\.00[ *]+1\\.00[ *]+37\\.50[ *]+"
                                    "- +- +- +- +\n"));
  EXPECT_THAT(table, Not(HasSubstr("second"))) << "the second method has no heights";
  EXPECT_THAT(table, Not(HasSubstr("*"))) << "a single method is not compared";
}

TEST_F(ThreeScans, HeightsAreOmittedIfUnknown) {
  const nlohmann::ordered_json json = to_json(results_);

  EXPECT_FALSE(has_heights(results_));
  EXPECT_FALSE(json["methods"][0].contains("heights"));
  EXPECT_FALSE(json["methods"][0]["per_scan"][0].contains("heights"));
  EXPECT_THAT(to_csv(results_), HasSubstr(",f1_by_area,milliseconds\r\n"));
}

TEST(SpeedTable, ShowsTheValuesOfThePaper) {
  std::vector<Method> methods(1);
  methods[0].name = methods[0].title = "patchwork";
  const std::vector<LabelledScan> scans = {{"a", {}, {}}};
  const std::vector<std::optional<ScanOutcome>> outcomes = {outcome_of({made(1, 1, 2)})};

  const std::string table = speed_table(gather(methods, scans, outcomes));

  EXPECT_THAT(table, AllOf(HasSubstr("500.0"), HasSubstr("43.97")));
}

}  // namespace
}  // namespace flagstone::eval
