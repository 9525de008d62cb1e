// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
// Usage errors: exit code 2, one line with the problem and the allowed values, nothing written.

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
  std::vector<std::string> arguments;  ///< SCAN, OUT, EMPTY and TOML are replaced by paths
  std::vector<std::string> messages;

  friend void PrintTo(const Misuse& misuse, std::ostream* out) { *out << misuse.name; }
};

class Usage : public testing::TestWithParam<Misuse> {};

TEST_P(Usage, IsRejectedOnOneLine) {
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
  for (const std::string& part : GetParam().messages)
    EXPECT_THAT(outcome.err, is_one_line_with(part));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

/// `flagstone segment SCAN --output OUT` and this.
Misuse segmenting(std::string name, const std::vector<std::string>& more,
                  std::vector<std::string> messages) {
  std::vector<std::string> arguments = {"segment", "SCAN", "--output", "OUT"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return {std::move(name), std::move(arguments), std::move(messages)};
}

INSTANTIATE_TEST_SUITE_P(
    Wrong, Usage,
    testing::Values(
        Misuse{"NoCommand", {}, {"no command given (expected segment, ", "--help"}},
        Misuse{
            "UnknownCommand", {"paint"}, {"paint: is not a command (expected segment, ", "--help"}},
        Misuse{"MisspelledCommand",
               {"segmnt", "SCAN"},
               {"segmnt: is not a command (did you mean 'segment'?", "--help"}},
        Misuse{"NoOutput",
               {"segment", "SCAN"},
               {"segment: -o, --output DIR is missing (see 'flagstone segment --help')"}},
        Misuse{"NoScan", {"segment", "--output", "OUT"}, {"SCAN... is missing"}},
        Misuse{"InfoOfNothing", {"info"}, {"SCAN... is missing"}},
        Misuse{"FolderWithoutScans",
               {"segment", "EMPTY", "--output", "OUT"},
               {"/empty: no scan", ".pcd.bin"}},
        Misuse{"SameOutputTwice",
               {"segment", "SCAN", "SCAN", "--output", "OUT"},
               {"would both write to scan.*"}},
        Misuse{"BenchOfNothing", {"bench"}, {"SCAN... is missing"}},
        Misuse{"BenchWithUnknownTarget",
               {"bench", "SCAN", "--isa", "abacus"},
               {"--isa", "abacus", "scalar"}},
        Misuse{"BenchOfNoRounds", {"bench", "SCAN", "--rounds", "0"}, {"--rounds", "1 to 1000000"}},
        Misuse{"BenchOfOtherMethods",
               {"bench", "SCAN", "--method", "gpf"},
               {"--method", "gpf", "patchwork", "surface"}},
        Misuse{"BenchWorkerWithoutPeers",
               {"bench", "SCAN", "--compare-worker", "OUT"},
               {"--compare-worker: needs --compare"}},
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
        segmenting("UnknownOption", {"--fast"},
                   {"--fast: is not an option of this command", "'flagstone segment --help'"}),
        segmenting("MisspelledOption", {"--hieghts"}, {"did you mean '--heights'?"}),
        segmenting("MisspelledOptionWithValue", {"--metod=gpf"},
                   {"--metod: is not an option of this command (did you mean '--method'?"}),
        segmenting("OptionWithoutValue", {"--columns"}, {"--columns: has no value (expected N;"}),
        segmenting("OptionGivenTwice", {"--columns", "4", "--columns", "5"},
                   {"--columns: is given more than once (expected once)"}),
        segmenting("ThreadsWithoutNumber", {"--threads", "x"}, {"--threads: x is not a number"}),
        Misuse{"OptionsThatExclude",
               {"doctor", "SCAN", "--json", "--toml"},
               {"--json: cannot be combined with --toml"}},
        Misuse{"UnexpectedArgument", {"demo", "street"}, {"street: unexpected argument"}},
        segmenting("MisspelledMethod", {"--method", "surfce"}, {"did you mean 'surface'?"}),
        segmenting("MisspelledPreset", {"--method", "patchwork", "--preset", "papr"},
                   {"did you mean 'paper'?"}),
        segmenting("MisspelledSensor", {"--sensor", "hdl-64"}, {"did you mean 'hdl-64e'?"}),
        segmenting("MisspelledSetting", {"--set", "sensor_hight=2"},
                   {"did you mean 'sensor_height'?"}),
        segmenting("MisspelledLabelMap", {"--label-map", "semantic_kitti"},
                   {"did you mean 'semantic-kitti'?"}),
        Misuse{"MisspelledScene",
               {"simulate", "--scene", "flat_stret", "--output", "OUT"},
               {"did you mean 'flat_street'?"}},
        Misuse{"MisspelledProtocol",
               {"eval", "EMPTY", "--protocol", "patchwrk"},
               {"did you mean 'patchwork'?"}},
        segmenting("UnknownPreset", {"--preset", "best"},
                   {"no preset is named 'best'", "default, paper, reference"}),
        segmenting("UnknownMethod", {"--method", "magic"}, {"magic", "patchwork"}),
        segmenting("UnknownFormat", {"--format", "las"},
                   {"no format is named 'las'", "label, u8, npy, pcd, ply, split"}),
        segmenting("FormatByNumber", {"--format", "2"}, {"label, u8, npy, pcd, ply, split"}),
        segmenting("UnknownLabelMap", {"--label-map", "x"}, {"flagstone, semantic-kitti"}),
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
                   {"this method has no setting 'distance_margin' (method patchwork has it)"}),
        segmenting("SectionOfPatchwork", {"--set", "elevation.enabled=false"},
                   {"this method has no setting 'elevation' (method patchwork has it)"}),
        segmenting("ZonesOfPatchwork", {"--set", "zones=[]"},
                   {"this method has no setting 'zones' (method patchwork has it)"}),
        segmenting("SettingOfSurface", {"--method", "patchwork", "--set", "point.margin=0.1"},
                   {"this method has no setting 'point' (method surface has it)"}),
        segmenting("SectionAsASetting", {"--set", "point=0.1"},
                   {"point must be a table of settings, got a floating-point number"}),
        segmenting("ConfigOfPatchwork", {"--config", "TOML"},
                   {"/mine.toml: line 1", "no setting 'seed_count'", "(method patchwork has it)"}),
        segmenting("TintWithoutZones", {"--image", "--color-patches"},
                   {"--color-patches: method surface has no zones", "--method patchwork"}),
        segmenting("HeightOutOfRange", {"--sensor-height", "101"},
                   {"sensor_height = 101", "-100 to 100 m"}),
        segmenting("HeightNoNumber", {"--sensor-height", "tall"},
                   {"--sensor-height: 'tall' is not a height"}),
        segmenting("NoThreads", {"--threads", "0"}, {"--threads", "1 to 1024"}),
        segmenting("TooFewColumns", {"--columns", "2"}, {"--columns", "3 to 1024"}),
        segmenting("ConfigNotThere", {"--config", "nowhere.toml"}, {"nowhere.toml: cannot"}),
        segmenting("ConfigOfWrongType", {"--method", "patchwork", "--config", "TOML"},
                   {"/mine.toml: line 2, column 15: seed_height must be a number"})),
    [](const auto& usage) { return usage.param.name; });

}  // namespace
}  // namespace flagstone::cli
