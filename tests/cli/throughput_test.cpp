// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/throughput.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace flagstone::cli {
namespace {

using testing::HasSubstr;

ScanReport report_of(double read_ms, double segment_ms, double write_ms) {
  ScanReport report;
  report.file_size = 2'000'000;
  report.read_ms = read_ms;
  report.segment_ms = segment_ms;
  report.write_ms = write_ms;
  return report;
}

TEST(Throughput, IsOfTheWholeCrewAndItsSharesAddUp) {
  const std::vector reports(100, report_of(4, 12, 2));

  EXPECT_EQ(
      throughput_text(reports, {.seconds = 1, .workers = 2}),
      "100.0 scans a second, 200.0 MB/s read; time of 2 workers: 20 % reading, 60 % "
      "segmenting, 10 % writing, 10 % other; segmenting binds: 6.000 ms of files, 12.000 ms of "
      "segmenting a scan\n");
}

TEST(Throughput, SaysThatFilesBindWhereReadingAndWritingTogetherTakeLonger) {
  EXPECT_THAT(
      throughput_text(std::vector{report_of(3, 4, 2)}, {.seconds = 0.01, .workers = 1}),
      HasSubstr("time of 1 worker: 30 % reading, 40 % segmenting, 20 % writing, 10 % other; "
                "reading and writing bind: 5.000 ms of files, 4.000 ms of segmenting a scan"));
}

TEST(Throughput, SaysThatNeitherBindsWherePicturesTakeLonger) {
  EXPECT_THAT(throughput_text(std::vector{report_of(1, 2, 1)}, {.seconds = 0.1, .workers = 1}),
              HasSubstr("96 % other; neither binds: "));
}

TEST(Throughput, LeavesFailedScansOut) {
  std::vector<ScanReport> reports(3, report_of(1, 2, 1));
  reports[1].error = "a.bin: byte 16: cut off";

  EXPECT_THAT(throughput_text(reports, {.seconds = 1, .workers = 1}),
              testing::StartsWith("2.0 scans a second, 4.0 MB/s read; "));
}

TEST(Throughput, OfNothingIsNotPrinted) {
  ScanReport failed;
  failed.error = "a.bin: byte 16: cut off";

  EXPECT_EQ(throughput_text({}, {.seconds = 1, .workers = 1}), "");
  EXPECT_EQ(throughput_text(std::vector{failed}, {.seconds = 1, .workers = 1}), "");
}

}  // namespace
}  // namespace flagstone::cli
