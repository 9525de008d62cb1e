// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Wrong usage: exit code 2, one line that says what is wrong and what is allowed, nothing written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

struct Misuse {
  std::string name;
  std::vector<std::string> arguments;  ///< SCAN, OUT, EMPTY and TOML stand for paths
  std::vector<std::string> said;

  friend void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.name; }
};

class Usage : public testing::TestWithParam<Misuse> {};

TEST_P(Usage, IsRefusedOnOneLine) {
  const io::TemporaryFolder folder;
  put_scan(folder / "scan.bin");
  io::put_file(folder / "mine.toml", "seed_count = 20\nseed_height = \"low\"\n");
  std::filesystem::create_directory(folder / "empty");
  std::vector<std::string> arguments = GetParam().arguments;
  std::ranges::replace(arguments, "SCAN", (folder / "scan.bin").string());
  std::ranges::replace(arguments, "OUT", (folder / "out").string());
  std::ranges::replace(arguments, "EMPTY", (folder / "empty").string());
  std::ranges::replace(arguments, "TOML", (folder / "mine.toml").string());

  const Outcome outcome = run(arguments);

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  for (const std::string& part : GetParam().said) EXPECT_THAT(outcome.err, is_one_line_with(part));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// `flagstone segment SCAN --output OUT` and this.
Misuse segmenting(std::string name, const std::vector<std::string>& more,
                  std::vector<std::string> said) {
  std::vector<std::string> arguments = {"segment", "SCAN", "--output", "OUT"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {std::move(name), std::move(arguments), std::move(said)};
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, Usage,
    testing::Values(
        Misuse{"NoCommand", {}, {"subcommand is required", "--help"}},
        Misuse{
            "UnknownCommand", {"paint"}, {"paint: is not a command (expected segment, ", "--help"}},
        Misuse{"MisspelledCommand",
               {"segmnt", "SCAN"},
               {"segmnt: is not a command (did you mean segment?", "--help"}},
        Misuse{"NoOutput", {"segment", "SCAN"}, {"--output is required"}},
        Misuse{"NoScan", {"segment", "--output", "OUT"}, {"scans is required"}},
        Misuse{"InfoOfNothing", {"info"}, {"scans is required"}},
        Misuse{"FolderWithoutScans",
               {"segment", "EMPTY", "--output", "OUT"},
               {"/empty: no scan", ".pcd.bin"}},
        Misuse{"SameOutputTwice",
               {"segment", "SCAN", "SCAN", "--output", "OUT"},
               {"would both write to scan.*"}},
        Misuse{"BenchOfNothing", {"bench"}, {"scans is required"}},
        Misuse{"BenchWithUnknownTarget",
               {"bench", "SCAN", "--isa", "abacus"},
               {"--isa", "abacus", "scalar"}},
        Misuse{"BenchOfNoRounds", {"bench", "SCAN", "--rounds", "0"}, {"--rounds", "1 to 1000000"}},
        Misuse{"BenchOfOtherMethods",
               {"bench", "SCAN", "--method", "gpf"},
               {"--method", "gpf", "patchwork", "surface"}},
        Misuse{"BenchWorkerWithoutPeers",
               {"bench", "SCAN", "--compare-worker", "OUT"},
               {"--compare-worker", "--compare"}},
        Misuse{"BenchOfBadSetting",
               {"bench", "SCAN", "--set", "point.margin=-1"},
               {"point.margin = -1"}},
        Misuse{"BenchWithAPresetOfPatchwork",
               {"bench", "SCAN", "--preset", "reference"},
               {"--preset reference", "--method patchwork"}},
        Misuse{"ConfigOfAPresetWithoutItsMethod",
               {"config", "--preset", "paper"},
               {"--preset paper: surface has no presets", "--method patchwork"}},
        Misuse{"ConfigSetsUnknownKey", {"config", "--set", "hight=2"}, {"no setting 'hight'"}},
        segmenting("UnknownOption", {"--fast"}, {"--fast", "--help"}),
        segmenting("UnknownPreset", {"--preset", "best"},
                   {"no preset is named 'best'", "default, paper, reference"}),
        segmenting("UnknownMethod", {"--method", "magic"}, {"magic", "patchwork"}),
        segmenting("UnknownFormat", {"--format", "las"}, {"las", "{label,npy,pcd,ply,split,u8}"}),
        segmenting("FormatByNumber", {"--format", "2"}, {"{label,npy,pcd,ply,split,u8}"}),
        segmenting("UnknownLabelMap", {"--label-map", "x"}, {"{flagstone,semantic-kitti}"}),
        segmenting("LabelMapOfAFormatWithoutCodes",
                   {"--label-map", "semantic-kitti", "--format", "ply"},
                   {"--label-map", "--format label or u8"}),
        segmenting("UnknownSetting", {"--set", "seed_cuont=3"}, {"no setting 'seed_cuont'"}),
        segmenting("SettingWithoutValue", {"--set", "seed_count"}, {"--set seed_count: line 1"}),
        segmenting("SettingOfManyLines", {"--set", "a=1\nb=2"}, {"--set a=1\\x0ab=2"}),
        segmenting("ValueOutOfRange", {"--method", "patchwork", "--set", "distance_margin=-0.5"},
                   {"distance_margin = -0.5", "above 0, up to 100 m"}),
        segmenting("PresetOfPatchwork", {"--preset", "paper"},
                   {"--preset paper", "--method patchwork"}),
        segmenting("SettingOfPatchwork", {"--set", "distance_margin=0.1"},
                   {"this method has no setting 'distance_margin'; --method patchwork has"}),
        segmenting("SectionOfPatchwork", {"--set", "elevation.enabled=false"},
                   {"this method has no setting 'elevation'; --method patchwork has"}),
        segmenting("ZonesOfPatchwork", {"--set", "zones=[]"},
                   {"this method has no setting 'zones'; --method patchwork has"}),
        segmenting("SettingOfSurface", {"--method", "patchwork", "--set", "point.margin=0.1"},
                   {"this method has no setting 'point'; --method surface has"}),
        segmenting("SectionAsASetting", {"--set", "point=0.1"},
                   {"point is a table of settings, not a floating-point"}),
        segmenting("ConfigOfPatchwork", {"--config", "TOML"},
                   {"/mine.toml: line 1", "no setting 'seed_count'", "--method patchwork"}),
        segmenting("TintWithoutZones", {"--image", "--color-patches"},
                   {"--color-patches: method surface has no zones", "--method patchwork"}),
        segmenting("HeightOutOfRange", {"--sensor-height", "101"},
                   {"sensor_height = 101", "-100 to 100 m"}),
        segmenting("HeightNoNumber", {"--sensor-height", "tall"},
                   {"--sensor-height: tall is no number"}),
        segmenting("NoThreads", {"--threads", "0"}, {"--threads", "1 to 1024"}),
        segmenting("TooFewColumns", {"--columns", "2"}, {"--columns", "3 to 1024"}),
        segmenting("ConfigNotThere", {"--config", "nowhere.toml"}, {"nowhere.toml: cannot"}),
        segmenting("ConfigOfWrongType", {"--method", "patchwork", "--config", "TOML"},
                   {"/mine.toml: line 2, column 15: seed_height is a number"})),
    [](const auto& usage) { return usage.param.name; });

}  // namespace
}  // namespace flagstone::cli
