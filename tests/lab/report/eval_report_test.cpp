// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/report/eval_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <regex>
#include <string>

#include "lab/report/example_results.hpp"
#include "lab/report/sweep_report.hpp"

namespace flagstone::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

// Number of occurrences of `part` in `text`.
std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

// The body of the report, without Chart.js and scripts.
std::string body_of(const std::string& page) {
  const std::size_t begin = page.find("<main>");
  return page.substr(begin, page.find("</main>") - begin);
}

TEST(EvalReport, ShowsProtocolScansMachineAndDate) {
  const std::string body = body_of(eval_report(example_eval(2, 10), {}));

  for (const char* fact :
       {"patchwork", "10 scans", "kitti, simulated", "Example CPU, 2 cores", "2026-11-21", "0.1.0"})
    EXPECT_THAT(body, HasSubstr(fact));
}

TEST(EvalReport, NamesEveryMethodAndScan) {
  const Json results = example_eval(9, 12);

  const std::string page = eval_report(results, {});

  for (const Json& method : results.at("methods")) {
    EXPECT_THAT(body_of(page), HasSubstr(">" + method.at("title").get<std::string>() + "<"));
    for (const Json& scan : method.at("per_scan"))
      EXPECT_THAT(page, HasSubstr(scan.at("scan").get<std::string>()));
  }
}

TEST(EvalReport, SetsTheHighestOfAColumnInBold) {
  Json results = example_eval(2, 10);
  results["methods"][0]["f1"]["mean"] = 0.9317;
  results["methods"][1]["f1"]["mean"] = 0.9316;

  const std::string body = body_of(eval_report(results, {}));

  EXPECT_THAT(body, HasSubstr("<b>93.17</b>"));
  EXPECT_THAT(body, HasSubstr("<td>93.16</td>"));
}

TEST(EvalReport, SetsAllValuesThatLookEqualInBold) {
  Json results = example_eval(2, 10);
  results["methods"][0]["f1"]["mean"] = 0.931701;
  results["methods"][1]["f1"]["mean"] = 0.931702;

  EXPECT_EQ(occurrences(body_of(eval_report(results, {})), "<b>93.17</b>"), 2);
}

TEST(EvalReport, SetsNothingInBoldForASingleMethod) {
  EXPECT_THAT(body_of(eval_report(example_eval(1, 10), {})), Not(HasSubstr("<b>")));
}

TEST(EvalReport, ShowsADashForTheDeviationOfOneScan) {
  const std::string body = body_of(eval_report(example_eval(1, 1), {}));

  EXPECT_THAT(body, HasSubstr("(1 scan)"));
  EXPECT_THAT(body, HasSubstr("<td>–</td>"));
  EXPECT_THAT(body, Not(HasSubstr("null")));
}

TEST(EvalReport, ShowsADashForTheSpeedOfLabelsOfOtherPrograms) {
  Json results = example_eval(1, 10);
  results["methods"][0]["hz"] = nullptr;
  results["methods"][0]["hz_slowest_1_percent"] = nullptr;

  EXPECT_EQ(occurrences(body_of(eval_report(results, {})), "<td>–</td>"), 2);
}

// Height errors of one method with this median error within 20 m, metres.
Json heights_with(double median) {
  const auto band = [&](int from, int to) {
    return Json{{"from", from},
                {"to", to},
                {"with_height", 0.987},
                {"median", {{"mean", median}}},
                {"percentile95", {{"mean", 0.0812}}},
                {"bias", {{"mean", -0.0034}}}};
  };
  const Json points = {{"by_range", {band(0, 20), band(20, 40)}}};
  return {{"ground", points}, {"everywhere", points}};
}

TEST(EvalReport, ShowsHeightErrorsInCentimetresWithTheLowestInBold) {
  Json results = example_eval(3, 10);
  results["methods"][0]["heights"] = heights_with(0.0123);
  results["methods"][1]["heights"] = heights_with(0.0234);

  const std::string body = body_of(eval_report(results, {}));

  EXPECT_THAT(body, HasSubstr("Heights above the ground"));
  EXPECT_THAT(body, HasSubstr("20–40 m, cm"));
  EXPECT_THAT(body, HasSubstr("<td><b>1.23</b></td><td><b>8.12</b></td><td>-0.34</td>"));
  EXPECT_THAT(body, HasSubstr("<td>2.34</td><td><b>8.12</b></td>"));
  EXPECT_THAT(body, HasSubstr("<b>98.70</b>"));
  EXPECT_EQ(occurrences(body, ">RANSAC<"), occurrences(body, ">LineFit<") + 2)
      << "the third method has no heights and no rows for them";
}

TEST(EvalReport, OmitsHeightsIfThereAreNone) {
  EXPECT_THAT(body_of(eval_report(example_eval(2, 10), {})), Not(HasSubstr("Heights")));
}

TEST(EvalReport, ListsTheWorstScansWithTheirF1) {
  Json results = example_eval(1, 10);
  results["methods"][0]["worst"] = {"00/000003"};
  results["methods"][0]["per_scan"][3]["f1"] = 0.4242;

  EXPECT_THAT(body_of(eval_report(results, {})),
              HasSubstr("<li><code>00/000003</code> <span>42.42</span></li>"));
}

TEST(EvalReport, ListsScansThatFailedWithTheReason) {
  Json results = example_eval(1, 10);
  results["failed"] = {{{"scan", "00/000077"}, {"error", "labels are missing"}}};

  EXPECT_THAT(body_of(eval_report(results, {})),
              HasSubstr("<code>00/000077</code> labels are missing"));
}

TEST(EvalReport, ContainsItsImages) {
  const std::array<ReportPicture, 1> pictures = {{{.title = "00/000000", .png = one_pixel_png()}}};

  const std::string body = body_of(eval_report(example_eval(1, 10), pictures));

  EXPECT_THAT(body, HasSubstr("src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(body, HasSubstr("loading=\"lazy\""));
  EXPECT_THAT(body, HasSubstr("<figcaption>00/000000</figcaption>"));
}

TEST(EvalReport, OmitsImagesAndFailuresIfThereAreNone) {
  const std::string body = body_of(eval_report(example_eval(1, 10), {}));

  EXPECT_THAT(body, Not(HasSubstr("<figure>")));
  EXPECT_THAT(body, Not(HasSubstr("Images")));
  EXPECT_THAT(body, Not(HasSubstr("Failures")));
}

TEST(EvalReport, AcceptsResultsWithoutMethods) {
  EXPECT_THAT(eval_report(example_eval(0, 0), {}), HasSubstr("0 scans"));
}

TEST(EvalReport, AcceptsAScanThatOnlySomeMethodsHave) {
  Json results = example_eval(2, 3);
  results["methods"][0]["per_scan"].erase(1);

  EXPECT_THAT(eval_report(results, {}), HasSubstr("00/000001"));
}

TEST(EvalReport, RejectsResultsInAnotherFormat) {
  Json results = example_eval(1, 10);
  results["methods"][0].erase("f1");

  EXPECT_THROW((void)eval_report(results, {}), Json::exception);
}

/// Moving points of one source.
Json example_moving() {
  Json figures = {{"iou", 0.4321},      {"recall", 0.5},
                  {"precision", 0.6},   {"kept", 0.9876},
                  {"points", 5000},     {"moving_points", 777},
                  {"marked_points", 9}, {"mean_iou", {{"mean", 0.3}, {"ci95", nullptr}}}};
  Json source = figures;
  source["name"] = "my <map>";
  source["by_range"] = {figures};
  source["by_range"][0]["from"] = 0;
  source["by_range"][0]["to"] = 10;
  return source;
}

TEST(EvalReport, ShowsMovingPointsByRange) {
  Json results = example_eval(1, 10);
  EXPECT_THAT(body_of(eval_report(results, {})), Not(HasSubstr("Moving points")));
  results["moving"] = {example_moving()};

  const std::string body = body_of(eval_report(results, {}));

  EXPECT_THAT(body, HasSubstr("<h2>Moving points</h2>"));
  EXPECT_THAT(body, HasSubstr("my &lt;map&gt;, 0–10 m"));
  EXPECT_THAT(body, HasSubstr("my &lt;map&gt;, all"));
  EXPECT_EQ(occurrences(body, "<td>43.21</td>"), 2);
  EXPECT_EQ(occurrences(body, "<td>777</td>"), 2);
}

TEST(EvalReport, HasOnlyMovingPointsWithoutMethods) {
  Json results = example_eval(1, 10);
  results["methods"] = Json::array();
  results["moving"] = {example_moving()};

  const std::string body = body_of(eval_report(results, {}));

  EXPECT_THAT(body, HasSubstr("<h1>Moving points of kitti, simulated (10 scans)</h1>"));
  EXPECT_THAT(body, HasSubstr("<h2>Moving points</h2>"));
  EXPECT_THAT(body, Not(HasSubstr("<h2>Methods</h2>")));
}

TEST(EvalReport, EscapesAllTextFromTheData) {
  const std::string attack = "</script><script>alert('\"1&')</script>";
  Json results = example_eval(1, 2);
  results["machine"] = attack;
  results["protocol"] = attack;
  results["datasets"] = {attack};
  results["date"] = attack;
  results["failed"] = {{{"scan", attack}, {"error", attack}}};
  results["methods"][0]["title"] = attack;
  results["methods"][0]["worst"] = {attack};
  results["methods"][0]["per_scan"][0]["scan"] = attack;
  const std::array<ReportPicture, 1> pictures = {{{.title = attack, .png = {}}}};

  const std::string page = eval_report(results, pictures);

  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(occurrences(page, "</script>"),
            occurrences(eval_report(example_eval(1, 2), {}), "</script>"));
}

TEST(Reports, AreSelfContained) {
  const std::regex loads(R"((src|href)\s*=\s*["']?\s*(https?:|//)|@import|url\()");
  for (const std::string& page :
       {eval_report(example_eval(9, 10), {}), sweep_report(example_sweep(3, 3))}) {
    EXPECT_THAT(page, Not(HasSubstr("<link")));
    EXPECT_THAT(page, Not(HasSubstr("<script src")));
    EXPECT_FALSE(std::regex_search(body_of(page), loads));
  }
}

TEST(Reports, ContainThePlottingLibrary) {
  for (const std::string& page :
       {eval_report(example_eval(9, 10), {}), sweep_report(example_sweep(3, 3))})
    EXPECT_THAT(page, HasSubstr("Chart.js v3"));
}

}  // namespace
}  // namespace flagstone::report
