// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/scan_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace flagstone::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Half of the ground is found, nothing else is taken for it: precision 1, recall 0.5, F1 2/3.
constexpr eval::Confusion half_found = {
    .true_positives = 10, .false_negatives = 10, .true_negatives = 20};

ScanReport report_of(const std::string& file) {
  ScanReport report;
  report.file = file;
  report.points = 40;
  report.counts = {20, 10, 1, 2, 7};
  report.patches = 5;
  report.read_ms = 1.5;
  report.segment_ms = 2.25;
  report.write_ms = 3.5;
  report.outputs = {"out/a.label"};
  return report;
}

TEST(ScanReport, JsonHasEveryNumberByName) {
  ScanReport report = report_of("a.bin");
  report.scores = {{"patchwork", half_found}};

  const json parsed = json::parse(json_line(report));

  EXPECT_EQ(parsed, json::parse(R"({
    "file": "a.bin", "points": 40, "patches": 5, "outputs": ["out/a.label"],
    "counts": {"nonground": 20, "ground": 10, "noise": 1, "out_of_range": 2, "invalid": 7},
    "milliseconds": {"read": 1.5, "segment": 2.25, "write": 3.5},
    "scores": {"patchwork": {"precision": 1.0, "recall": 0.5, "f1": 0.6666666666666666,
                             "accuracy": 0.75}}})"));
}

TEST(ScanReport, JsonStartsWithTheFileAndIsOneLine) {
  const std::string line = json_line(report_of("two\nlines.bin"));

  EXPECT_THAT(line, testing::StartsWith(R"({"file":"two\nlines.bin","points":40,)"));
  EXPECT_THAT(line, Not(HasSubstr("\n")));
}

TEST(ScanReport, JsonOfAFailureHasTheErrorAndNoNumbers) {
  ScanReport report;
  report.file = "a.bin";
  report.error = "a.bin: byte 16: cut off";

  EXPECT_EQ(json::parse(json_line(report)),
            json::parse(R"({"file": "a.bin", "error": "a.bin: byte 16: cut off"})"));
}

TEST(ScanReport, JsonOfANonUtf8FileNameCanBeParsed) {
  EXPECT_TRUE(json::accept(json_line(report_of("\xff\xfe.bin"))));
}

TEST(ScanReport, JsonHasTheImageTimeIfThereIsAnImage) {
  ScanReport report = report_of("a.bin");
  report.picture_ms = 9.5;

  EXPECT_EQ(json::parse(json_line(report))["milliseconds"]["picture"], 9.5);
}

TEST(ScanReport, TextLineHasFilePointsGroundPercentageAndTimes) {
  EXPECT_EQ(text_line(report_of("a.bin")),
            "a.bin: 40 points, 25.0 % ground, 5 patches; read 1.50 ms, segment 2.25 ms, "
            "write 3.50 ms");
}

TEST(ScanReport, TextLineHasF1OfEveryProtocol) {
  ScanReport report = report_of("a.bin");
  report.scores = {{"one", half_found}, {"other", {.true_positives = 1}}};

  EXPECT_THAT(text_line(report), testing::EndsWith("; F1 66.67 % (one); F1 100.00 % (other)"));
}

TEST(ScanReport, GroundFractionOfNoPointsIsZero) { EXPECT_EQ(ScanReport().ground_share(), 0); }

TEST(ScanReport, SummaryCountsScansAndAveragesOverScans) {
  std::vector<ScanReport> reports = {report_of("a.bin"), report_of("b.bin"), report_of("c.bin")};
  reports[0].scores = {{"patchwork", half_found}};
  reports[1].scores = {{"patchwork", {.true_positives = 1000}}};
  reports[2].error = "c.bin: byte 16: cut off";

  EXPECT_EQ(summary_text(reports),
            "protocol patchwork    precision 100.00  recall  75.00  F1  83.33  "
            "(mean of 2 scans, %)\n"
            "2 of 3 scans segmented, 80 points, median 2.25 ms per scan\n");
}

TEST(ScanReport, SummaryOfFailuresHasNoTime) {
  ScanReport failed;
  failed.error = "a.bin: byte 16: cut off";

  EXPECT_EQ(summary_text(std::vector{failed}), "0 of 1 scans segmented, 0 points\n");
}

TEST(ScanReport, HintsAtWrongUnitsIfMostPointsAreOutOfRange) {
  ScanReport report = report_of("a.bin");
  report.counts = {5, 10, 0, 20, 5};
  EXPECT_EQ(hint_of(report), "");

  report.counts = {5, 9, 0, 21, 5};
  EXPECT_THAT(text_line(report), HasSubstr("; most points are out of range (expected metres and "));
  EXPECT_THAT(text_line(report), HasSubstr("'flagstone doctor'"));
  EXPECT_EQ(json::parse(json_line(report))["hint"], hint_of(report));
}

TEST(ScanReport, FileNameCannotBreakTheLineOrControlTheTerminal) {
  const std::string line = text_line(report_of("two\nlines\033[2J.bin"));

  EXPECT_THAT(line, testing::StartsWith("two\\x0alines\\x1b[2J.bin: "));
}

ScanReport timed_report(double read_ms, double segment_ms, double write_ms) {
  ScanReport report;
  report.file_size = 2'000'000;
  report.read_ms = read_ms;
  report.segment_ms = segment_ms;
  report.write_ms = write_ms;
  return report;
}

TEST(Throughput, PercentagesOfAllWorkersAddUp) {
  const std::vector reports(100, timed_report(4, 12, 2));

  EXPECT_EQ(
      throughput_text(reports, {.seconds = 1, .workers = 2}),
      "100.0 scans per second, 200.0 MB/s read; 2 workers: 20 % reading, 60 % segmenting, 10 % "
      "writing, 10 % other; bottleneck: segmentation (per scan 6.000 ms file I/O, 12.000 ms "
      "segmentation)\n");
}

TEST(Throughput, ReportsFilesAsBottleneckIfReadingAndWritingTakeLonger) {
  EXPECT_THAT(
      throughput_text(std::vector{timed_report(3, 4, 2)}, {.seconds = 0.01, .workers = 1}),
      HasSubstr(
          "1 worker: 30 % reading, 40 % segmenting, 20 % writing, 10 % other; bottleneck: file "
          "I/O (per scan 5.000 ms file I/O, 4.000 ms segmentation)"));
}

TEST(Throughput, ReportsNoBottleneckIfImagesTakeLonger) {
  EXPECT_THAT(throughput_text(std::vector{timed_report(1, 2, 1)}, {.seconds = 0.1, .workers = 1}),
              HasSubstr("96 % other; bottleneck: neither ("));
}

TEST(Throughput, ExcludesFailedScans) {
  std::vector<ScanReport> reports(3, timed_report(1, 2, 1));
  reports[1].error = "a.bin: byte 16: cut off";

  EXPECT_THAT(throughput_text(reports, {.seconds = 1, .workers = 1}),
              testing::StartsWith("2.0 scans per second, 4.0 MB/s read; "));
}

TEST(Throughput, IsEmptyWithoutScans) {
  ScanReport failed;
  failed.error = "a.bin: byte 16: cut off";

  EXPECT_EQ(throughput_text({}, {.seconds = 1, .workers = 1}), "");
  EXPECT_EQ(throughput_text(std::vector{failed}, {.seconds = 1, .workers = 1}), "");
}

}  // namespace
}  // namespace flagstone::app
