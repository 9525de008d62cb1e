// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/sweep_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "lab/report/example_results.hpp"

namespace flagstone::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

constexpr const char* a_plot = "<canvas";
constexpr const char* a_heat_table = "<table class=\"heat\">";

TEST(SweepReport, ShowsTheKeysAndTheBestSetting) {
  const std::string page = sweep_report(example_sweep(3, 2));

  for (const char* fact :
       {"Sweep of bins and uprightness.angle for r_gpf", "10 scans", "20x36 won by 1.3 intervals"})
    EXPECT_THAT(page, HasSubstr(fact));
}

TEST(SweepReport, ListsEverySetting) {
  const std::string page = sweep_report(example_sweep(3, 2));

  for (const char* value : {"10x36", "20x36", "30x36", "30", "35"})
    EXPECT_THAT(page, HasSubstr("<th scope=\"row\">" + std::string(value) + "</th>"));
}

TEST(SweepReport, PlotsLinesOverTheFirstKey) {
  EXPECT_THAT(sweep_report(example_sweep(3, 2)),
              AllOf(HasSubstr(a_plot), Not(HasSubstr(a_heat_table))));
}

TEST(SweepReport, PlotsASweepOfOneKey) {
  EXPECT_THAT(sweep_report(example_sweep(3, 0)),
              AllOf(HasSubstr(a_plot), Not(HasSubstr(a_heat_table))));
}

TEST(SweepReport, ShadesATableForManyNumbers) {
  EXPECT_THAT(sweep_report(example_sweep(3, 7, true)),
              AllOf(Not(HasSubstr(a_plot)), HasSubstr(a_heat_table)));
}

TEST(SweepReport, PlotsLinesForUpToSixNumbers) {
  EXPECT_THAT(sweep_report(example_sweep(3, 6, true)), HasSubstr(a_plot));
}

TEST(SweepReport, PlotsLinesIfAKeyIsNotNumeric) {
  EXPECT_THAT(sweep_report(example_sweep(3, 7)), HasSubstr(a_plot));
}

TEST(SweepReport, ShadesFromTheLowestToTheHighestMean) {
  Json results = example_sweep(2, 7, true);
  results["cells"][0]["f1"]["mean"] = 0.9876;
  results["cells"][1]["f1"]["mean"] = 0.1234;

  const std::string page = sweep_report(results);

  EXPECT_THAT(page, HasSubstr("<td style=\"--shade: 1.000\">98.76</td>"));
  EXPECT_THAT(page, HasSubstr("<td style=\"--shade: 0.000\">12.34</td>"));
}

TEST(SweepReport, ShowsADashForCellsMissingFromTheSweep) {
  Json results = example_sweep(2, 7, true);
  results["cells"].erase(3);

  EXPECT_THAT(sweep_report(results), HasSubstr("<td style=\"--shade: 0.000\">–</td>"));
}

TEST(SweepReport, EscapesAllTextFromTheData) {
  const std::string attack = "</script><script>alert('1')</script>";
  for (const std::size_t thresholds : {2u, 7u}) {
    Json results = example_sweep(2, thresholds, true);
    results["winner"] = attack;
    results["method"] = attack;
    results["keys"][0] = attack;
    results["cells"][0]["values"][0] = attack;

    EXPECT_THAT(sweep_report(results), Not(HasSubstr("<script>alert")));
  }
}

TEST(SweepReport, RejectsMoreThanTwoKeys) {
  Json results = example_sweep(2, 2);
  results["keys"] = {"a", "b", "c"};

  EXPECT_THROW((void)sweep_report(results), std::invalid_argument);
}

}  // namespace
}  // namespace flagstone::report
