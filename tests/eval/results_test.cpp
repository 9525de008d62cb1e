// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "eval/results.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eval/results_csv.hpp"
#include "eval/results_json.hpp"
#include "eval/results_text.hpp"

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

/// Two methods on three scans, of which one could not be read, and one not by the second method.
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
    results_.datasets = {"made up"};
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

TEST_F(ThreeScans, PooledFiguresAreOverPoints) {
  EXPECT_EQ(results_.methods[0].pooled.true_positives, 160);
  EXPECT_EQ(results_.methods[0].by_range[0].total(), 200);
}

TEST_F(ThreeScans, HzIsOneOverTheMeanTime) {
  EXPECT_DOUBLE_EQ(results_.methods[0].hz.value(), 500);
  EXPECT_DOUBLE_EQ(results_.methods[0].hz_slowest_1_percent.value(), 1000.0 / 3);
}

TEST_F(ThreeScans, WhatFailedIsListed) {
  ASSERT_EQ(results_.failures.size(), 2u);
  EXPECT_EQ(results_.failures[0].scan, "b");
  EXPECT_EQ(results_.failures[0].error, "b: unreadable");
}

TEST_F(ThreeScans, TheWorstScanComesFirst) {
  EXPECT_THAT(worst_scans(results_.methods[0], 5), ElementsAre(1, 0));
  EXPECT_THAT(worst_scans(results_.methods[0], 1), ElementsAre(1));
}

TEST_F(ThreeScans, JsonHoldsWhatReadersOfItAreTold) {
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

TEST_F(ThreeScans, TheBestOfAColumnStandsOut) {
  EXPECT_THAT(accuracy_table(results_, {.bold = false}), HasSubstr("80.00*"));
  EXPECT_THAT(accuracy_table(results_, {.bold = true}),
              AllOf(HasSubstr("\x1b[1m"), HasSubstr("80.00\x1b[0m")));
}

TEST_F(ThreeScans, EveryMethodHasARowAndMissingFiguresADash) {
  const std::string table = accuracy_table(results_, {});

  EXPECT_THAT(table, AllOf(HasSubstr("\nfirst"), HasSubstr("\nsecond")));
  EXPECT_THAT(table.substr(table.find("second")), HasSubstr(" - "));
}

TEST_F(ThreeScans, AMethodThatMissesScansIsNotComparedAndSaysSo) {
  outcomes_[0]->methods[1] = made(99, 1, 4);  // better than the first, on one scan of two

  const Results results = gather(methods_, scans_, outcomes_);

  EXPECT_THAT(accuracy_table(results, {}), AllOf(HasSubstr("80.00*"), Not(HasSubstr("99.00*")),
                                                 HasSubstr("second: 1 of 2 scans")));
}

TEST_F(ThreeScans, AScanWithoutAScoredPointCountsNowhere) {
  outcomes_[2] = outcome_of({made(0, 0, 1), made(0, 0, 1)});

  const Results results = gather(methods_, scans_, outcomes_);

  EXPECT_EQ(results.scans, 1u);
  EXPECT_THAT(results.unscored, ElementsAre("c,\"1\""));
  EXPECT_DOUBLE_EQ(results.methods[0].f1.mean, made(90, 10, 1).score.points.f1());
}

TEST(SpeedTable, PutsThePapersFiguresBesideOurs) {
  std::vector<Method> methods(1);
  methods[0].name = methods[0].title = "patchwork";
  const std::vector<LabelledScan> scans = {{"a", {}, {}}};
  const std::vector<std::optional<ScanOutcome>> outcomes = {outcome_of({made(1, 1, 2)})};

  const std::string table = speed_table(gather(methods, scans, outcomes));

  EXPECT_THAT(table, AllOf(HasSubstr("500.0"), HasSubstr("43.97")));
}

}  // namespace
}  // namespace flagstone::eval
