// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/config/config_toml.hpp"
#include "app/config/method_choice.hpp"
#include "app/config/same_config.hpp"
#include "cli/command_process.hpp"
#include "cli/files.hpp"
#include "files/io/file_contents.hpp"
#include "files/io/temporary_folder.hpp"
#include "flagstone/make_segmenter.hpp"
#include "flagstone/mount.hpp"
#include "flagstone/sensor.hpp"
#include "library/methods/method.hpp"

namespace flagstone::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string robot =
    "beams = 16\nelevation_top = 15.0\nelevation_bottom = -15.0\nheight = 0.6\n";

Outcome config_of_patchwork(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"config", "--method", "patchwork"});
  return run(arguments);
}

PatchworkConfig printed_config(const std::vector<std::string>& arguments) {
  const Outcome outcome = config_of_patchwork(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  MethodConfig config = PatchworkConfig{};
  MountSettings mount;
  config::apply_toml(outcome.out, "config", config, mount);
  return *config.get_if<PatchworkConfig>();
}

PatchworkConfig derived(const char* name, double height) {
  Sensor sensor = Sensor::named(name);
  sensor.height = height;
  return PatchworkConfig::for_sensor(sensor);
}

class SensorOption : public testing::Test {
 protected:
  std::string put(const char* name, const std::string& text) const {
    io::put_file(folder_ / name, text);
    return (folder_ / name).string();
  }
  io::TemporaryFolder folder_;
};

TEST_F(SensorOption, DerivesTheSettingsOfEveryKnownSensor) {
  for (const Sensor& sensor : Sensor::known()) {
    EXPECT_TRUE(
        is_same(printed_config({"--sensor", sensor.name}), PatchworkConfig::for_sensor(sensor)))
        << sensor.name;
  }
}

TEST_F(SensorOption, PrintsTheSensorAndTheRuleInTheHeader) {
  EXPECT_THAT(
      config_of_patchwork({"--sensor", "os0-128"}).out,
      AllOf(testing::StartsWith("# flagstone, method patchwork, derived from sensor os0-128\n"),
            HasSubstr("h / tan(-elevation)"),
            HasSubstr("docs/explanation/settings-from-a-sensor.md")));
}

TEST_F(SensorOption, AcceptsAFile) {
  const PatchworkConfig config = printed_config({"--sensor", put("robot.toml", robot)});
  const PatchworkConfig of_the_same_beams = PatchworkConfig::for_sensor("vlp-16");

  EXPECT_EQ(config.sensor_height, 0.6f);
  EXPECT_EQ(config.zones.front().ring_radii, of_the_same_beams.zones.front().ring_radii);
}

TEST_F(SensorOption, IsAKeyOfTheConfigFileThatIsAppliedFirst) {
  const std::string file = put("mine.toml", "distance_margin = 0.2\nsensor = \"vlp-16\"\n");
  PatchworkConfig expected = PatchworkConfig::for_sensor("vlp-16");
  expected.distance_margin = 0.2f;

  EXPECT_TRUE(is_same(printed_config({"--config", file}), expected));
}

TEST_F(SensorOption, FileInAConfigFileIsRelativeToIt) {
  put("robot.toml", robot);
  const std::string file = put("mine.toml", "sensor = \"robot.toml\"\n");

  EXPECT_EQ(printed_config({"--config", file}).sensor_height, 0.6f);
}

TEST_F(SensorOption, DerivesSettingsForTheConfiguredHeight) {
  const PatchworkConfig expected = derived("vlp-16", 1.5);
  const std::string file = put("mine.toml", "sensor_height = 1.5\n");

  EXPECT_TRUE(is_same(printed_config({"--sensor", "vlp-16", "--sensor-height", "1.5"}), expected));
  EXPECT_TRUE(
      is_same(printed_config({"--sensor", "vlp-16", "--set", "sensor_height=1.5"}), expected));
  EXPECT_TRUE(is_same(printed_config({"--sensor", "vlp-16", "--config", file}), expected));
}

TEST_F(SensorOption, KeepsItsZonesIfTheOriginIsOnTheGround) {
  PatchworkConfig expected = PatchworkConfig::for_sensor("os0-128");
  expected.sensor_height = 0;

  EXPECT_TRUE(is_same(printed_config({"--sensor", "os0-128", "--sensor-height", "0"}), expected));
}

TEST_F(SensorOption, SettingsOverrideIt) {
  PatchworkConfig expected = PatchworkConfig::for_sensor("at128");
  expected.uprightness.angle = 60;
  expected.zones = {{.ring_radii = {20, 40}, .sectors = 8}};

  EXPECT_TRUE(is_same(printed_config({"--sensor", "at128", "--set", "uprightness.angle=60", "--set",
                                      "zones=[{ring_radii=[20, 40], sectors=8}]"}),
                      expected));
}

TEST_F(SensorOption, WorksWithEveryMethod) {
  for (const std::string_view method : config::method_names()) {
    MethodConfig config = default_config(method);
    const Outcome outcome = run({"config", "--method", std::string(method), "--sensor", "vlp-16"});

    ASSERT_EQ(outcome.exit_code, 0) << method << ": " << outcome.err;
    MountSettings mount;
    config::apply_toml(outcome.out, "config", config, mount);
    EXPECT_EQ(config::to_toml(config),
              config::to_toml(default_config(method, Sensor::named("vlp-16"))))
        << method;
    EXPECT_EQ(sensor_height_of(config, 0.6f), 0.6f) << method;
  }
}

TEST_F(SensorOption, IsRejectedWithAPreset) {
  const Outcome outcome = config_of_patchwork({"--sensor", "vlp-16", "--preset", "paper"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--sensor: cannot be combined with --preset paper"));
  EXPECT_EQ(config_of_patchwork({"--sensor", "vlp-16", "--preset", "default"}).exit_code, 0);
}

TEST_F(SensorOption, RejectsInvalidSensorsOnOneLine) {
  const std::string named = put("named.toml", "sensor = \"vlp-16\"\n");
  const std::string wrong = put("wrong.toml", "sensor = 3\n");
  const std::string unknown = put("unknown.toml", "sensor = \"os9\"\n");
  const std::string bad = put("bad.toml", robot + "max_range = -1\n");
  const std::string blind = put("blind.toml", "elevations = [5, 0]\nheight = 1\n");
  const auto expect = [](const std::vector<std::string>& arguments, const std::string& reason) {
    const Outcome outcome = config_of_patchwork(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << reason;
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_EQ(lines_of(outcome.err).size(), 1U) << outcome.err;
  };

  expect({"--sensor", "os9"}, "--sensor: no sensor is named 'os9' (expected hdl-64e");
  expect({"--sensor", bad}, "bad.toml: line 5, column 13: ");
  expect({"--sensor", blind}, "no beam meets flat ground");
  expect({"--sensor", "vlp-16", "--config", named}, "named.toml also sets a sensor");
  expect({"--config", unknown}, "unknown.toml: sensor: no sensor is named");
  expect({"--config", wrong}, "wrong.toml: line 1, column 10: sensor must be a string");
  expect({"--set", "sensor=\"vlp-16\""}, "cannot set the sensor (use --sensor");
}

TEST_F(SensorOption, IsTheSameInSegmentEvalAndConfig) {
  const std::string scan = put("velodyne.bin", "");
  put_scan(scan);
  const std::string settings = put("vlp.toml", config_of_patchwork({"--sensor", "vlp-16"}).out);
  const auto labels = [&](const char* output, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"segment",   scan,       "--method",
                                          "patchwork", "--output", (folder_ / output).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exit_code, 0);
    return io::contents_of(folder_ / output / "velodyne.label");
  };

  const auto by_name = labels("name", {"--sensor", "vlp-16"});

  EXPECT_EQ(by_name, labels("file", {"--config", settings}));
  EXPECT_NE(by_name, labels("default", {}));
}

TEST(SensorsCommand, ListsEveryKnownSensorWithItsZones) {
  const Outcome outcome = run({"sensors"});

  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(lines_of(outcome.out).size(), Sensor::known().size() + 1);
  for (const Sensor& sensor : Sensor::known()) EXPECT_THAT(outcome.out, HasSubstr(sensor.title));
}

TEST(SensorsCommand, ListsTheNamedSensorsAndReportsUnknownOnes) {
  const Outcome outcome = run({"sensors", "vlp-16", "os9"});

  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(lines_of(outcome.out).size(), 2U);
  EXPECT_THAT(outcome.err, HasSubstr("no sensor is named 'os9'"));
}

}  // namespace
}  // namespace flagstone::cli
