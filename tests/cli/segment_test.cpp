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
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

/// The label codes of a scan.
std::vector<std::uint32_t> label_codes(const io::Cloud& scan) {
  std::vector<std::uint32_t> codes;
  for (const Label label : labels_of(scan)) codes.push_back(static_cast<std::uint32_t>(label));
  return codes;
}

/// Writes scans of 0, 100, 200, ... points to a directory.
void put_scans(const fs::path& folder, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    put_scan(folder / (std::to_string(100 + i) + ".bin"), small_scan(100 * i, 1));
  }
}

TEST(Segment, WritesOneLabelCodePerPoint) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");

  const Outcome outcome =
      run({"segment", (folder / "scan.bin").string(), "--output", (folder / "deep/out").string()});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(lines_of(outcome.out), ElementsAre(HasSubstr("scan.bin: 4000 points, ")));
  EXPECT_THAT(names_below(folder / "deep/out"), ElementsAre("scan.label"));
  EXPECT_EQ(fs::file_size(folder / "deep/out/scan.label"), 4 * 4000U);
  const auto codes = codes_of(folder / "deep/out/scan.label");
  EXPECT_EQ(codes, label_codes(small_scan()));
  for (std::uint32_t code = 0; code < label_count; ++code) {
    EXPECT_THAT(codes, testing::Contains(code));
  }
}

TEST(Segment, SemanticKittiCodesAre40ForGroundOtherwise0) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  std::vector<std::uint32_t> expected;
  for (const Label label : labels_of(small_scan())) {
    expected.push_back(label == Label::ground ? 40 : 0);
  }

  const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                               (folder / "out").string(), "--label-map", "semantic-kitti"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(codes_of(folder / "out/scan.label"), expected);
}

TEST(Segment, ReadsFiveColumnsFromNuScenesFilesAndByOption) {
  const io::TemporaryFolder folder;
  io::Cloud five;
  ASSERT_TRUE(io::Cloud::from_floats(std::vector<float>(300, 1.0f), 5, five).ok());
  put_scan(folder / "named.pcd.bin", five);
  put_scan(folder / "given.bin", five);

  EXPECT_EQ(
      run({"segment", (folder / "named.pcd.bin").string(), "--output", (folder / "out").string()})
          .exit_code,
      0);
  EXPECT_EQ(run({"segment", (folder / "given.bin").string(), "--output", (folder / "out").string(),
                 "--columns", "5"})
                .exit_code,
            0);

  EXPECT_EQ(codes_of(folder / "out/named.label").size(), 60U);
  EXPECT_EQ(codes_of(folder / "out/given.label").size(), 60U);
}

TEST(Segment, AcceptsAnEmptyFileAsAScanWithoutPoints) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "empty.bin", "");

  const Outcome outcome = run({"segment", (folder / "empty.bin").string(), "--output",
                               (folder / "out").string(), "--image"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(fs::file_size(folder / "out/empty.label"), 0U);
}

TEST(Segment, JsonIsOneObjectPerScanInInputOrder) {
  const io::TemporaryFolder folder;
  put_scans(folder / "scans", 12);

  const Outcome outcome = run({"segment", (folder / "scans").string(), "--output",
                               (folder / "out").string(), "--threads", "4", "--json"});

  EXPECT_EQ(outcome.exit_code, 0);
  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 12U);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const json scan = json::parse(lines[i]);
    const std::string name = std::to_string(100 + i);
    EXPECT_EQ(scan["file"], (folder / ("scans/" + name + ".bin")).string());
    EXPECT_EQ(scan["points"], 100 * i);
    std::size_t sum = 0;
    for (const auto& count : scan["counts"]) sum += count.get<std::size_t>();
    EXPECT_EQ(scan["counts"].size(), label_count);
    EXPECT_EQ(sum, 100 * i);
    EXPECT_EQ(scan["patches"].get<int>() > 0, i > 0);
    EXPECT_EQ(scan["outputs"], json::array({(folder / ("out/" + name + ".label")).string()}));
    for (const char* step : {"read", "segment", "write"}) {
      EXPECT_GE(scan["milliseconds"][step].get<double>(), 0);
    }
  }
}

TEST(Segment, OutputDoesNotDependOnTheNumberOfThreads) {
  const io::TemporaryFolder folder;
  put_scans(folder / "scans", 20);

  for (const std::string threads : {"1", "2", "5"}) {
    EXPECT_EQ(run({"segment", (folder / "scans").string(), "--output", (folder / threads).string(),
                   "--threads", threads, "--format", "pcd"})
                  .exit_code,
              0);
  }

  EXPECT_EQ(names_below(folder / "1").size(), 20U);
  EXPECT_EQ(files_below(folder / "2"), files_below(folder / "1"));
  EXPECT_EQ(files_below(folder / "5"), files_below(folder / "1"));
}

TEST(Segment, EndsWithASummaryAndTheBottleneck) {
  const io::TemporaryFolder folder;
  put_scans(folder / "scans", 3);

  const Outcome outcome = run({"segment", (folder / "scans").string(), "--output",
                               (folder / "out").string(), "--threads", "2"});

  const std::vector<std::string> lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_THAT(lines[3], StartsWith("3 of 3 scans segmented, 300 points, median "));
  EXPECT_THAT(lines[4], testing::ContainsRegex("^[0-9.]+ scans per second, [0-9.]+ MB/s read; 2 "
                                               "workers: .* bottleneck: .* ms segmentation\\)$"));
}

TEST(Segment, WritesAnImageNextToTheLabels) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");

  const Outcome outcome = run({"segment", (folder / "scan.bin").string(), "--output",
                               (folder / "out").string(), "--image", "--json"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(names_below(folder / "out"), ElementsAre("scan.label", "scan.png"));
  EXPECT_THAT(io::contents_of(folder / "out/scan.png"), StartsWith("\x89PNG\r\n\x1a\n"));
  const json scan = json::parse(outcome.out);
  EXPECT_EQ(scan["outputs"].back(), (folder / "out/scan.png").string());
  EXPECT_TRUE(scan["milliseconds"].contains("picture"));
}

TEST(Segment, ImagesAreDeterministic) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  for (const char* output : {"one", "two"}) {
    ASSERT_EQ(run({"segment", (folder / "scan.bin").string(), "--output",
                   (folder / output).string(), "--image", "--surface"})
                  .exit_code,
              0);
  }

  EXPECT_THAT(names_below(folder / "one"), testing::IsSupersetOf({"scan.png", "scan.surface.png"}));
  EXPECT_EQ(files_below(folder / "one") == files_below(folder / "two"), true);
}

TEST(Segment, SuggestsTheDoctorForAScanInMillimetres) {
  const io::TemporaryFolder folder;
  const io::Cloud metres = small_scan();
  std::vector<float> values;
  for (std::size_t i = 0; i < metres.size(); ++i) {
    const Point p = metres.view()[i];
    values.insert(values.end(), {1000 * p.x, 1000 * p.y, 1000 * p.z, 0});
  }
  io::Cloud millimetres;
  ASSERT_TRUE(io::Cloud::from_floats(values, 4, millimetres).ok());
  put_scan(folder / "scan.bin", millimetres);

  const Outcome outcome =
      run({"segment", (folder / "scan.bin").string(), "--output", (folder / "out").string()});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(lines_of(outcome.out),
              ElementsAre(testing::AllOf(HasSubstr("most points are out of range"),
                                         HasSubstr("flagstone doctor"))));
}

}  // namespace
}  // namespace flagstone::cli
