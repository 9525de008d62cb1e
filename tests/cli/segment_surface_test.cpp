// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/float_array.hpp"
#include "files/io/temporary_folder.hpp"
#include "files/render/height_map.hpp"
#include "flagstone/segmentation.hpp"
#include "flagstone/surface.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::Pointwise;

class SegmentSurface : public testing::Test {
 protected:
  SegmentSurface() { put_scan(folder_ / "scan.bin"); }

  [[nodiscard]] Outcome segment(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"segment", (folder_ / "scan.bin").string(), "--output",
                                          (folder_ / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  io::TemporaryFolder folder_;
};

TEST_F(SegmentSurface, IsRejectedForMethodsWithoutASurface) {
  for (const std::string option : {"--heights", "--surface"}) {
    const Outcome outcome = segment({"--method", "patchwork", option});

    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(
        outcome.err,
        is_one_line_with(option + ": method patchwork computes no surface (expected --method "
                                  "surface)"));
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
}

TEST_F(SegmentSurface, RejectsAResolutionWithoutASurface) {
  const Outcome outcome = segment({"--surface-resolution", "0.5"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, is_one_line_with("--surface-resolution: needs --surface"));
}

TEST_F(SegmentSurface, RejectsAResolutionOutOfRange) {
  for (const std::string resolution : {"0.09", "10.1", "-1", "nan", "fine"}) {
    const Outcome outcome = segment({"--surface", "--surface-resolution", resolution});

    EXPECT_EQ(outcome.exit_code, 2) << resolution;
    EXPECT_THAT(outcome.err, is_one_line_with("(expected 0.1 to 10)")) << resolution;
  }
}

/// With the method that computes a surface.
class SegmentBySurface : public SegmentSurface {
 protected:
  void SetUp() override {
    Surface segmenter;
    ASSERT_TRUE(segmenter.segment(scan_.view(), expected_).ok());
  }

  /// Runs the command and expects success.
  Outcome segment_by_surface(std::vector<std::string> more) const {
    more.insert(more.end(), {"--method", "surface"});
    Outcome outcome = segment(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome;
  }

  io::Cloud scan_ = small_scan();
  Segmentation expected_;
};

MATCHER_P(has_the_bits_of, expected, "the same numbers, NaN or not") {
  return std::ranges::equal(std::as_bytes(std::span(arg)), std::as_bytes(expected));
}

TEST_F(SegmentBySurface, WritesTheHeightOfEveryPoint) {
  segment_by_surface({"--heights"});

  EXPECT_THAT(names_below(folder_ / "out"), ElementsAre("scan.heights.npy", "scan.label"));
  const io::FloatArray heights = io::float_array_of(folder_ / "out/scan.heights.npy");
  EXPECT_THAT(heights.shape, ElementsAre(scan_.size()));
  EXPECT_THAT(heights.values, has_the_bits_of(expected_.heights()));
}

TEST_F(SegmentBySurface, AddsAHeightFieldToALabelledCloud) {
  for (const std::string format : {"npy", "pcd", "ply"}) {
    segment_by_surface({"--heights", "--format", format});

    const io::Cloud written = scan_of(folder_ / ("out/scan." + format));
    ASSERT_EQ(written.fields().back().name, "height");
    EXPECT_NE(written.find("label"), nullptr);
    std::vector<float> heights;
    heights.reserve(written.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
      heights.push_back(static_cast<float>(written.value(i, written.fields().back())));
    }
    EXPECT_THAT(heights, Pointwise(testing::NanSensitiveFloatEq(), expected_.heights())) << format;
  }
}

TEST_F(SegmentBySurface, AddsNoHeightFieldByDefault) {
  segment_by_surface({"--format", "pcd"});

  EXPECT_EQ(scan_of(folder_ / "out/scan.pcd").find("height"), nullptr);
}

TEST_F(SegmentBySurface, WritesTheGroundAsAGridWithGeometryAndMap) {
  segment_by_surface({"--surface"});

  EXPECT_THAT(names_below(folder_ / "out"), ElementsAre("scan.label", "scan.surface.json",
                                                        "scan.surface.npy", "scan.surface.png"));
  EXPECT_THAT(io::contents_of(folder_ / "out/scan.surface.png"),
              testing::StartsWith("\x89PNG\r\n\x1a\n"));
  const GroundSurface& surface = expected_.surface();
  const render::HeightMap map =
      render::map_of(surface, surface.extent(), surface.grids().back().cell);
  EXPECT_THAT(io::float_array_of(folder_ / "out/scan.surface.npy").values,
              has_the_bits_of(std::span<const float>(map.heights)));
}

TEST_F(SegmentBySurface, WritesCellsOfTheGivenSize) {
  segment_by_surface({"--surface", "--surface-resolution", "2"});

  const auto width = static_cast<std::size_t>(expected_.surface().extent());
  EXPECT_THAT(io::float_array_of(folder_ / "out/scan.surface.npy").shape,
              ElementsAre(width, width));
}

TEST_F(SegmentBySurface, ListsItsOutputsInJson) {
  const Outcome outcome = segment_by_surface({"--heights", "--surface", "--image", "--json"});

  const auto outputs = nlohmann::json::parse(outcome.out)["outputs"];
  std::vector<std::string> names;
  for (const std::string output : outputs) names.push_back(fs::path(output).filename());
  EXPECT_THAT(names, ElementsAre("scan.label", "scan.heights.npy", "scan.surface.npy",
                                 "scan.surface.json", "scan.png", "scan.surface.png"));
}

}  // namespace
}  // namespace flagstone::cli
