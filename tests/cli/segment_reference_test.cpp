// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/label_files.hpp"
#include "files/io/temporary_folder.hpp"
#include "lab/eval/protocol.hpp"
#include "lab/eval/score.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Classes of SemanticKITTI by height: road below -1.6 m, vegetation to -1 m, building above.
std::vector<std::uint32_t> made_up_classes(const io::Cloud& scan) {
  std::vector<std::uint32_t> classes;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float z = scan.view()[i].z;
    classes.push_back(z < -1.6f ? 40 : z < -1 ? 70 : 50);
  }
  return classes;
}

/// Two scans, and their labels in another directory of the same structure.
class WithReference : public testing::Test {
 protected:
  WithReference() {
    fs::create_directories(folder_ / "labels");
    for (const std::string name : {"a", "b"}) {
      put_scan(folder_ / ("scans/" + name + ".bin"));
      EXPECT_TRUE(io::write_class_file(folder_ / ("labels/" + name + ".label"),
                                       made_up_classes(small_scan()))
                      .ok());
    }
  }

  [[nodiscard]] Outcome segment(const std::string& scan, const std::string& reference,
                                const std::string& output,
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"segment",     (folder_ / scan).string(),
                                          "--output",    (folder_ / output).string(),
                                          "--reference", (folder_ / reference).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_F(WithReference, F1IsPrintedPerScanAndProtocolAndAsAMean) {
  const Outcome outcome = segment("scans", "labels", "out");

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto has_both = AllOf(testing::ContainsRegex("F1 [0-9.]+ % \\(patchwork\\)"),
                              testing::ContainsRegex("F1 [0-9.]+ % \\(patchwork\\+\\+\\)"));
  EXPECT_THAT(lines_of(outcome.out),
              ElementsAre(has_both, has_both, HasSubstr("protocol patchwork "),
                          HasSubstr("protocol patchwork++ "), HasSubstr("2 of 2 scans"),
                          HasSubstr(" scans per second")));
}

TEST_F(WithReference, ScoresMatchTheEvaluationLibrary) {
  const io::Cloud scan = small_scan();
  const auto classes = made_up_classes(scan);

  const json printed =
      json::parse(segment("scans/a.bin", "labels/a.label", "out", {"--json"}).out)["scores"];

  EXPECT_EQ(printed.size(), 2U);
  for (const eval::Protocol* protocol :
       {&eval::patchwork_protocol(), &eval::patchwork_plusplus_protocol()}) {
    const eval::Confusion expected =
        eval::compare(labels_of(scan), eval::truth_of(*protocol, scan.view(), classes));
    EXPECT_EQ(printed[protocol->name]["precision"], expected.precision());
    EXPECT_EQ(printed[protocol->name]["recall"], expected.recall());
    EXPECT_EQ(printed[protocol->name]["f1"], expected.f1());
    EXPECT_EQ(printed[protocol->name]["accuracy"], expected.accuracy());
  }
}

TEST_F(WithReference, ScanWithoutTrueGroundHasNoF1AndIsNotInTheMeans) {
  const std::vector<std::uint32_t> buildings(small_scan().size(), 50);
  const Status status = io::write_class_file(folder_ / "labels/b.label", buildings);
  ASSERT_TRUE(status.ok()) << status.message();

  const Outcome outcome = segment("scans", "labels", "out");

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("; F1 n/a % (patchwork)"));
  EXPECT_THAT(outcome.out, HasSubstr("(mean of 1 scans, without 1 that have no ground, %)"));
}

TEST_F(WithReference, ScoresLidarsegLabelsUnderTheirProtocol) {
  io::put_file(folder_ / "a_lidarseg.bin", std::string(4000, '\x18'));  // 24: driveable surface

  const json printed = json::parse(segment("scans/a.bin", "", "out", {"--json"}).out)["scores"];

  ASSERT_EQ(printed.size(), 1U);
  EXPECT_EQ(printed[eval::lidarseg_protocol().name]["precision"], 1.0);
}

TEST_F(WithReference, ReportsAReferenceOfTheWrongSizeWithBothNumbers) {
  io::put_file(folder_ / "short.label", std::string(4 * 3999, '\0'));

  const Outcome outcome = segment("scans/a.bin", "short.label", "out");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              AllOf(is_one_line_with("short.label"), HasSubstr("3999"), HasSubstr("4000")));
}

TEST_F(WithReference, ReportsTheNameOfAMissingReference) {
  fs::remove(folder_ / "labels/b.label");

  const Outcome outcome = segment("scans", "labels", "out");

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, is_one_line_with((folder_ / "labels/b.label").string()));
  EXPECT_THAT(outcome.out, HasSubstr("1 of 2 scans segmented"));
}

TEST_F(WithReference, DoesNotOverwriteTheReference) {
  const auto before = files_below(folder_ / "labels");

  const Outcome outcome = segment("scans/a.bin", "labels", "labels");

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              is_one_line_with("labels/a.label: this output would overwrite the input"));
  EXPECT_EQ(files_below(folder_ / "labels"), before);
}

}  // namespace
}  // namespace flagstone::cli
