// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/sweep.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/config/same_config.hpp"
#include "cli/command_process.hpp"
#include "flagstone/baselines.hpp"

namespace flagstone::app {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// The error message of `action`; "no error" if there is none.
template <class Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

std::string error_of_value(const std::string& key, const std::string& value,
                           MethodConfig config = PatchworkConfig{}) {
  return error_of([&] { apply_axis(key, value, config); });
}

TEST(SweepAxis, HasAKeyAndItsValuesInOrder) {
  const SweepAxis axis = sweep_axis("elevation.scale=0.5,0.1,0");

  EXPECT_EQ(axis.key, "elevation.scale");
  EXPECT_THAT(axis.values, ElementsAre("0.5", "0.1", "0"));
  EXPECT_THAT(sweep_axis("bins=30x108").values, ElementsAre("30x108"));
}

TEST(SweepAxis, IsRejectedWithAnExampleWithoutKeyOrValues) {
  for (const std::string text : {"", "seed_count", "seed_count=", "=3"}) {
    EXPECT_THAT(error_of([&] { static_cast<void>(sweep_axis(text)); }),
                AllOf(HasSubstr("--param " + text), HasSubstr("KEY=VALUE,VALUE")));
  }
}

TEST(SweepAxis, SetsASettingOfAnyMethod) {
  register_baselines();
  MethodConfig patchwork = PatchworkConfig{};
  MethodConfig gpf = GpfConfig{};

  apply_axis("uprightness.angle", "30", patchwork);
  apply_axis("segments", "5", gpf);

  PatchworkConfig expected;
  expected.uprightness.angle = 30;
  EXPECT_TRUE(is_same(*patchwork.get_if<PatchworkConfig>(), expected));
  EXPECT_EQ(gpf.get_if<GpfConfig>()->segments, 5);
}

TEST(SweepAxis, BinsSetOneZoneOfEqualRingsUpToTheOldOuterRadius) {
  MethodConfig config = PatchworkConfig{};
  const PatchworkConfig before;

  apply_axis("bins", "4x36", config);

  const auto& made = *config.get_if<PatchworkConfig>();
  ASSERT_EQ(made.zones.size(), 1U);
  EXPECT_EQ(made.zones[0].sectors, 36);
  const auto& radii = made.zones[0].ring_radii;
  ASSERT_EQ(radii.size(), 4U);
  const float outer = before.zones.back().ring_radii.back();
  const float width = (outer - before.min_range) / 4;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(radii[i], before.min_range + width * static_cast<float>(i + 1), 1e-4f);
  }
  EXPECT_EQ(radii.back(), outer);
}

TEST(SweepAxis, BinsOfThePaperGiveTheGridOfRGpf) {
  MethodConfig config = r_gpf_config();

  apply_axis("bins", "30x108", config);

  EXPECT_TRUE(is_same(*config.get_if<PatchworkConfig>(), r_gpf_config()));
}

TEST(SweepAxis, RejectsInvalidBins) {
  for (const std::string value :
       {"30", "x", "30x", "x108", "0x108", "30x0", "-3x108", "30x108x2", "30 x108", "1001x4"}) {
    EXPECT_THAT(error_of_value("bins", value),
                AllOf(HasSubstr("bins = " + value), HasSubstr("30x108")));
  }
}

TEST(SweepAxis, RejectsBinsForMethodsWithoutZones) {
  register_baselines();
  EXPECT_THAT(error_of_value("bins", "30x108", GpfConfig{}), HasSubstr("--method patchwork"));
}

TEST(SweepAxis, NamesTheOptionForAnInvalidSettingOrValue) {
  EXPECT_THAT(error_of_value("seed_cuont", "3"),
              AllOf(HasSubstr("--param seed_cuont=3"),
                    HasSubstr("no setting 'seed_cuont' (did you mean 'seed_count'?)")));
  EXPECT_THAT(error_of_value("seed_count", "many"), HasSubstr("--param seed_count=many"));
  EXPECT_THAT(error_of_value("seed_count", ""), HasSubstr("--param seed_count="));
}

/// A point of a sweep. Its scans of 100 points have these values of F1 in percent.
eval::MethodResult point_of(const std::vector<int>& f1_percent) {
  eval::MethodResult result;
  std::vector<double> values;
  for (const int percent : f1_percent) {
    eval::ScanScore scan;
    scan.scan = std::to_string(values.size());
    // precision = recall = F1
    scan.score.points = {.true_positives = static_cast<double>(percent),
                         .false_positives = 100.0 - percent,
                         .false_negatives = 100.0 - percent};
    result.scans.push_back(scan);
    values.push_back(scan.score.points.f1());
  }
  result.precision = result.recall = result.f1 = eval::spread_of(values);
  return result;
}

/// A sweep over seed_count with a point per value.
Sweep sweep_of(const std::vector<std::string>& values,
               const std::vector<std::vector<int>>& f1_percent) {
  Sweep sweep{.method = "patchwork", .axes = {{"seed_count", values}}, .results = {}};
  sweep.results.protocol = "patchwork";
  sweep.results.datasets = {"kitti"};
  sweep.results.scans = f1_percent[0].size();
  for (const auto& percents : f1_percent) sweep.results.methods.push_back(point_of(percents));
  return sweep;
}

TEST(SweepResults, LastAxisChangesFastest) {
  const Sweep sweep{
      .method = "", .axes = {{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}}, .results = {}};

  EXPECT_THAT(sweep.values_at(0), ElementsAre("1", "x"));
  EXPECT_THAT(sweep.values_at(2), ElementsAre("1", "z"));
  EXPECT_THAT(sweep.values_at(3), ElementsAre("2", "x"));
  EXPECT_THAT(sweep.values_at(5), ElementsAre("2", "z"));
}

TEST(SweepResults, WinnerTextComparesTheLeadWithItsConfidenceInterval) {
  // Differences of 4, 6 and 5 percentage points: mean 5, standard deviation 1, half-width
  // 4.303 / sqrt(3) = 2.484.
  const Sweep sweep = sweep_of({"5", "10", "20"}, {{50, 60, 70}, {80, 90, 95}, {76, 84, 90}});

  EXPECT_EQ(winner_text(sweep),
            "Best F1: 88.33 % at seed_count = 10; 5.00 percentage points ahead of seed_count = 20, "
            "2.0 times the half-width of its 95 % confidence interval: significant.");
}

TEST(SweepResults, LeadWithinItsIntervalIsNotSignificant) {
  const Sweep sweep = sweep_of({"5", "10"}, {{50, 90}, {80, 61}});

  EXPECT_THAT(winner_text(sweep), HasSubstr("at seed_count = 10; 0.50 percentage points ahead"));
  EXPECT_THAT(winner_text(sweep), HasSubstr(": not significant."));
}

TEST(SweepResults, LeadThatIsEqualOnEveryScanNeedsNoInterval) {
  const Sweep sweep = sweep_of({"5", "10"}, {{50, 50}, {50, 50}});

  EXPECT_EQ(
      winner_text(sweep),
      "Best F1: 50.00 % at seed_count = 5; 0.00 percentage points ahead of seed_count = 10, the "
      "same difference on every scan.");
}

TEST(SweepResults, OneScanHasNoConfidenceInterval) {
  EXPECT_THAT(
      winner_text(sweep_of({"5", "10"}, {{50}, {60}})),
      HasSubstr("10.00 percentage points ahead of seed_count = 5; one scan gives no confidence "
                "interval."));
}

TEST(SweepResults, OnePointIsTheWinner) {
  EXPECT_EQ(winner_text(sweep_of({"5"}, {{50, 70}})), "Best F1: 60.00 % at seed_count = 5.");
}

TEST(SweepResults, CsvHasARowPerPointAndEmptyCellsForMissingNumbers) {
  const std::string csv = to_csv(sweep_of({"5", "1,5"}, {{50}, {60}}));

  EXPECT_EQ(csv,
            "seed_count,scans,precision_mean,precision_std,precision_ci95,recall_mean,recall_std,"
            "recall_ci95,f1_mean,f1_std,f1_ci95\r\n"
            "5,1,0.500000,,,0.500000,,,0.500000,,\r\n"
            "\"1,5\",1,0.600000,,,0.600000,,,0.600000,,\r\n");
}

TEST(SweepResults, TextHasARowPerPointInPercent) {
  const std::vector<std::string> lines =
      cli::lines_of(to_text(sweep_of({"5", "10"}, {{50, 60}, {70}})));

  ASSERT_EQ(lines.size(), 3U);
  EXPECT_THAT(lines[0], HasSubstr("seed_count"));
  EXPECT_THAT(lines[1], testing::ContainsRegex("^ +5 +55.00 +7.07 +55.00 +7.07 +55.00 +7.07 +63"));
  EXPECT_THAT(lines[2], testing::ContainsRegex("^ +10 +70.00 "));
}

TEST(SweepResults, TextColumnsAreSeparatedAndAlignedWithTheirHeadings) {
  Sweep sweep = sweep_of({"true", "false"}, {{50, 60}, {70, 80}});
  sweep.axes[0].key = "sparse_bins_are_ground";

  const std::vector<std::string> lines = cli::lines_of(to_text(sweep));

  EXPECT_THAT(lines[0], HasSubstr("sparse_bins_are_ground  precision    std"));
  const std::size_t end = lines[0].find("precision") + std::string("precision").size();
  EXPECT_EQ(lines[1].substr(end - 6, 6), " 55.00");
  EXPECT_EQ(lines[1][end], ' ');
}

TEST(SweepResults, JsonHasACellPerPoint) {
  const auto json = to_json(sweep_of({"5", "10"}, {{50, 60}, {70, 80}}));

  EXPECT_EQ(json["method"], "patchwork");
  EXPECT_EQ(json["protocol"], "patchwork");
  EXPECT_EQ(json["scans"], 2);
  EXPECT_EQ(json["keys"], nlohmann::json::array({"seed_count"}));
  ASSERT_EQ(json["cells"].size(), 2U);
  EXPECT_EQ(json["cells"][1]["values"], nlohmann::json::array({"10"}));
  EXPECT_DOUBLE_EQ(json["cells"][1]["f1"]["mean"], 0.75);
  EXPECT_TRUE(json["cells"][1]["f1"]["ci95"].is_number());
  EXPECT_THAT(json["winner"].get<std::string>(), HasSubstr("seed_count = 10"));
}

}  // namespace
}  // namespace flagstone::app
