// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "app/config/method_choice.hpp"
#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/baselines.hpp"
#include "flagstone/segmentation.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// The label codes of a method of the library.
std::vector<std::uint32_t> codes_by(Segmenter& method, const io::Cloud& scan) {
  Segmentation result;
  EXPECT_TRUE(method.segment(scan.view(), result).ok());
  std::vector<std::uint32_t> codes;
  for (const Label label : result.labels()) codes.push_back(static_cast<std::uint32_t>(label));
  return codes;
}

class SegmentMethod : public testing::TestWithParam<std::string> {
 protected:
  SegmentMethod() { put_scan(folder_ / "scan.bin"); }

  [[nodiscard]] Outcome segment(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"segment",  (folder_ / "scan.bin").string(),
                                          "--output", (folder_ / "out").string(),
                                          "--method", GetParam()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_P(SegmentMethod, WritesTheLabelsOfTheLibrary) {
  const Outcome outcome = segment({});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto codes = codes_of(folder_ / "out/scan.label");
  EXPECT_EQ(codes, codes_by(*make_segmenter(GetParam()), small_scan()));
  const auto ground = std::ranges::count(codes, static_cast<std::uint32_t>(Label::ground));
  EXPECT_GT(ground, 200);
  EXPECT_LT(ground, 3900);
}

TEST_P(SegmentMethod, PrintsItsSettingsAsTomlThatReadsBack) {
  const Outcome printed = run({"config", "--method", GetParam()});
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_THAT(lines_of(printed.out)[0], HasSubstr("method " + GetParam()));
  io::put_file(folder_ / "mine.toml", printed.out);
  const std::string file = (folder_ / "mine.toml").string();

  const Outcome again = run({"config", "--method", GetParam(), "--config", file});
  const Outcome segmented = segment({"--config", file});

  EXPECT_EQ(again.out, printed.out);
  EXPECT_EQ(segmented.exit_code, 0) << segmented.err;
  EXPECT_EQ(codes_of(folder_ / "out/scan.label"),
            codes_by(*make_segmenter(GetParam()), small_scan()));
}

TEST_P(SegmentMethod, DrawsAnImage) {
  const Outcome outcome = segment({"--image"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(io::contents_of(folder_ / "out/scan.png"), testing::StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST_P(SegmentMethod, ColorsPatchesIfItHasZonesAndOtherwiseRejectsTheOption) {
  const bool has_zones = default_config(GetParam()).get_if<PatchworkConfig>() != nullptr;

  const Outcome outcome = segment({"--image", "--color-patches"});

  if (has_zones) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(fs::exists(folder_ / "out/scan.png"));
  } else {
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err,
                is_one_line_with("--color-patches: method " + GetParam() + " has no zones"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

std::vector<std::string> names() {
  const auto all = config::method_names();
  return {all.begin(), all.end()};
}

INSTANTIATE_TEST_SUITE_P(Methods, SegmentMethod, testing::ValuesIn(names()),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::ranges::replace(name, '+', '_');
                           return name;
                         });

TEST(SegmentWithMethod, AcceptsOnlySettingsOfTheMethod) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  const auto segment = [&](const std::string& method, const std::string& setting) {
    return run({"segment", (folder / "scan.bin").string(), "--output", (folder / "out").string(),
                "--method", method, "--set", setting});
  };

  const Outcome right = segment("gpf", "distance_margin=0.02");
  const Outcome wrong = segment("ransac", "elevation.enabled=false");

  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(codes_of(folder / "out/scan.label"),
            codes_by(*make_segmenter("gpf", GpfConfig{.distance_margin = 0.02f}), small_scan()));
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, is_one_line_with("no setting 'elevation'"));
}

}  // namespace
}  // namespace flagstone::cli
