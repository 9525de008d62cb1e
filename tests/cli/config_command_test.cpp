// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "app/config/config_toml.hpp"
#include "app/config/same_config.hpp"
#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "cli/line_matchers.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"

namespace flagstone::cli {
namespace {

/// The configuration of Patchwork that `flagstone config` prints.
PatchworkConfig printed_config(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"config", "--method", "patchwork"});
  const Outcome outcome = run(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  MethodConfig config = PatchworkConfig{};
  MountSettings mount;
  config::apply_toml(outcome.out, "config", config, mount);
  return *config.get_if<PatchworkConfig>();
}

TEST(ConfigCommand, PrintsTheSettingsOfSurfaceByDefault) {
  const Outcome outcome = run({"config"});

  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, run({"config", "--method", "surface"}).out);
  EXPECT_THAT(outcome.out, testing::StartsWith("# flagstone, method surface\n"));
}

TEST(ConfigCommand, PrintsTheNamedPreset) {
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    EXPECT_TRUE(
        is_same(printed_config({"--preset", std::string(name)}), PatchworkConfig::preset(name)))
        << name;
  }
}

TEST(ConfigCommand, AppliesPresetThenFileThenSettingThenSensorHeight) {
  const io::TemporaryFolder folder;
  io::put_file(folder / "mine.toml", "iterations = 5\nseed_count = 5\nsensor_height = 5\n");
  PatchworkConfig expected = PatchworkConfig::preset("paper");
  expected.iterations = 5;
  expected.seed_count = 6;
  expected.elevation.enabled = false;
  expected.sensor_height = 7;

  const PatchworkConfig config =
      printed_config({"--preset", "paper", "--sensor-height", "7", "--set", "seed_count=6", "--set",
                      "elevation.enabled=false", "--set", "sensor_height=6", "--config",
                      (folder / "mine.toml").string()});

  EXPECT_TRUE(is_same(config, expected));
}

TEST(ConfigCommand, PrintedPresetGivesTheLabelsOfThePreset) {
  const io::TemporaryFolder folder;
  const std::string scan = (folder / "scan.bin").string();
  const std::string toml = (folder / "paper.toml").string();
  put_scan(scan);
  io::put_file(toml, run({"config", "--method", "patchwork", "--preset", "paper"}).out);

  const auto segment = [&](const char* output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"segment",   scan,       "--method",
                                          "patchwork", "--output", (folder / output).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  };
  const Outcome named = segment("named", {"--preset", "paper"});
  const Outcome printed = segment("printed", {"--config", toml});
  segment("default", {});

  EXPECT_EQ(named.exit_code, 0);
  EXPECT_EQ(printed.exit_code, 0);
  EXPECT_EQ(files_below(folder / "named"), files_below(folder / "printed"));
  EXPECT_NE(files_below(folder / "named"), files_below(folder / "default"))
      << "the presets give equal labels for this scan";
}

TEST(ConfigCommand, ReportsUnwritableStandardOutput) {
  const Outcome outcome = CommandProcess({"config"}, "/dev/full").finish();

  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err,
              is_one_line_with("standard output: cannot be written (is the disk full?)"));
}

}  // namespace
}  // namespace flagstone::cli
