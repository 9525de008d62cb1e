// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/doctor/street_scan.hpp"
#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

using doctor::changed;
using doctor::cloud_of;
using doctor::street_scan;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Point upside_down(Point p) { return {p.x, -p.y, -p.z}; }

/// Scans in a temporary directory.
class DoctorCommand : public testing::Test {
 protected:
  [[nodiscard]] std::string fine_scan(const std::string& name = "fine.npy") const {
    put_scan(folder_ / name, cloud_of(street_scan()));
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string upside_down_scan() const {
    put_scan(folder_ / "down.npy", cloud_of(changed(street_scan(), upside_down)));
    return (folder_ / "down.npy").string();
  }

  io::TemporaryFolder folder_;
};

TEST_F(DoctorCommand, ExitsWithZeroAndPrintsSettingsForAGoodScan) {
  const Outcome outcome = run({"doctor", fine_scan()});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Nothing to fix. Recommended settings:"),
                                 testing::EndsWith("sensor_height = 1.73  # metres above the "
                                                   "ground\n")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\033")));
}

TEST_F(DoctorCommand, PrintsTheFixFirstAndExitsWithOne) {
  const Outcome outcome = run({"doctor", upside_down_scan()});

  EXPECT_EQ(outcome.exit_code, 1);
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_GE(lines.size(), 4u);
  EXPECT_THAT(lines[2], AllOf(testing::StartsWith("fix   axes "), HasSubstr("upside down")));
  EXPECT_THAT(lines[3], HasSubstr("mount.up = [0.0, 0.0, -1.0]"));
  for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << line;
}

TEST_F(DoctorCommand, PrintsOneJsonObjectWithEveryFinding) {
  const Outcome outcome = run({"doctor", upside_down_scan(), "--json"});

  const json report = json::parse(outcome.out);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(report["scans"], testing::SizeIs(1));
  EXPECT_EQ(report["method"], "surface");
  EXPECT_EQ(report["fix"], 1);
  EXPECT_EQ(report["note"], 0);
  EXPECT_THAT(report["toml"].get<std::string>(), HasSubstr("up = [0.0, 0.0, -1.0]"));
  for (const json& finding : report["findings"]) {
    EXPECT_TRUE(finding["sentence"].is_string());
    EXPECT_TRUE(finding["remedy"].is_string());
    EXPECT_TRUE(finding["values"].is_object());
    EXPECT_EQ(finding["severity"], finding["id"] == "axes" ? "fix" : "fine") << finding;
  }
}

TEST_F(DoctorCommand, PrintsOrWritesOnlyTheSettings) {
  const std::string scan = upside_down_scan();
  const std::string file = (folder_ / "doctor.toml").string();

  const Outcome printed = run({"doctor", scan, "--toml"});
  const Outcome written = run({"doctor", scan, "--output", file});

  EXPECT_THAT(lines_of(printed.out), testing::Contains("[mount]"));
  EXPECT_EQ(io::contents_of(file), printed.out);
  EXPECT_THAT(lines_of(written.out), Not(testing::Contains("[mount]")));
  const Outcome segmented =
      run({"segment", scan, "--output", (folder_ / "labels").string(), "--config", file, "--json"});
  EXPECT_EQ(segmented.exit_code, 0) << segmented.err;
}

TEST_F(DoctorCommand, ComparesWithTheGivenSettings) {
  const Outcome outcome = run({"doctor", fine_scan(), "--sensor-height", "2.5", "--json"});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(json::parse(outcome.out)["fix"], 1);
}

TEST_F(DoctorCommand, ReportsAnUnreadableScanOnOneLineAndExaminesTheOthers) {
  io::put_file(folder_ / "broken.pcd", "VERSION 0.7\nFIELDS x y\n");

  const Outcome outcome = run({"doctor", (folder_ / "broken.pcd").string(), fine_scan()});

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with((folder_ / "broken.pcd").string() + ": byte "));
  EXPECT_THAT(outcome.out, HasSubstr("Nothing to fix"));
}

TEST_F(DoctorCommand, JsonListsUnreadableScans) {
  const std::string good = fine_scan();
  const std::string bad = (folder_ / "broken.pcd").string();
  io::put_file(bad, "VERSION 0.7\nFIELDS x y\n");

  for (const bool is_alone : {true, false}) {
    std::vector<std::string> words = {"doctor", bad, "--json"};
    if (!is_alone) words.push_back(good);
    const Outcome outcome = run(words);

    EXPECT_EQ(outcome.exit_code, 1);
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["scans"], is_alone ? json::array() : json::array({good}));
    ASSERT_EQ(report["errors"].size(), 1U);
    EXPECT_EQ(report["errors"][0]["file"], bad);
    EXPECT_THAT(report["errors"][0]["error"].get<std::string>(), HasSubstr(bad + ": byte "));
    EXPECT_EQ(report["toml"].is_null(), is_alone);
  }
}

TEST_F(DoctorCommand, ExaminesEvenlySpacedScansOfADirectory) {
  const io::Cloud small = cloud_of({{1, 2, 3}});
  for (int i = 0; i < 10; ++i) put_scan(folder_ / ("scans/" + std::to_string(i) + ".npy"), small);

  const Outcome outcome =
      run({"doctor", (folder_ / "scans").string(), "--max-scans", "3", "--json"});

  const json scans = json::parse(outcome.out)["scans"];
  const auto file = [&](const char* name) { return (folder_ / "scans" / name).string(); };
  EXPECT_THAT(scans, ElementsAre(file("0.npy"), file("3.npy"), file("6.npy")));
}

TEST_F(DoctorCommand, ReportsTooFewPointsForAnEmptyScan) {
  io::put_file(folder_ / "empty.bin", "");

  const Outcome outcome = run({"doctor", (folder_ / "empty.bin").string(), "--json"});

  const json report = json::parse(outcome.out);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(report["findings"][0]["id"], "points");
  EXPECT_EQ(report["findings"][0]["severity"], "fix");
  EXPECT_TRUE(report["toml"].is_null());
}

TEST_F(DoctorCommand, RejectsUsageErrors) {
  EXPECT_EQ(run({"doctor"}).exit_code, 2);
  EXPECT_EQ(run({"doctor", "scan.bin", "--max-scans", "0"}).exit_code, 2);
  EXPECT_EQ(run({"doctor", "scan.bin", "--json", "--toml"}).exit_code, 2);
  EXPECT_EQ(run({"doctor", folder_.path().string()}).exit_code, 2);
}

}  // namespace
}  // namespace flagstone::cli
