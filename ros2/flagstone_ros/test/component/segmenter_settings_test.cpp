// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "segmenter_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "declaration.hpp"
#include "flagstone/patchwork_config.hpp"

namespace flagstone_ros {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::VariantWith;

std::string reason(const ParameterValues& given) {
  try {
    static_cast<void>(SegmenterSettings(given).make());
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(SegmenterSettings, AreTheDefaultsOfSurfaceIfNothingIsGiven) {
  const SegmenterSettings settings(ParameterValues{});
  const ParameterValues values = settings.values();

  EXPECT_THAT(values.at("sensor_height"), VariantWith<double>(1.73));
  EXPECT_THAT(values.at("tilt"), VariantWith<std::string>("off"));
  EXPECT_EQ(values.count("point.margin"), 1u);
  EXPECT_EQ(values.count("uprightness.angle"), 0u);
  EXPECT_FALSE(settings.uses_imu());
  EXPECT_FALSE(settings.estimates_mount());
}

TEST(SegmenterSettings, HaveTheNamesDescriptionsAndRangesOfFlagstone) {
  for (const SettingParameter& setting : SegmenterSettings(ParameterValues{}).settings()) {
    EXPECT_FALSE(setting.description.empty()) << setting.name;
    if (setting.name != "max_range") continue;
    EXPECT_TRUE(setting.is_number);
    EXPECT_EQ(setting.low, 8);
    EXPECT_EQ(setting.high, 200);
    EXPECT_EQ(setting.constraints, "8 to 200 m");
  }
}

TEST(SegmenterSettings, DoNotRepeatWhatSensorHeightAndTiltSet) {
  for (const SettingParameter& setting : SegmenterSettings(ParameterValues{}).settings()) {
    EXPECT_NE(setting.name, "sensor_height");
    EXPECT_NE(setting.name, "mount.height");
    EXPECT_NE(setting.name, "mount.tilt");
    EXPECT_NE(setting.name, "mount.up");
  }
}

TEST(SegmenterSettings, AreChangedByTheirNames) {
  const SegmenterSettings settings({{"point.margin", 0.2}, {"mount.scale", 0.001}});

  EXPECT_THAT(settings.values().at("point.margin"), VariantWith<double>(0.2));
  EXPECT_DOUBLE_EQ(settings.scale(), 0.001f);
}

TEST(SegmenterSettings, IgnoreNamesThatAreNotTheirs) {
  EXPECT_EQ(reason({{"use_sim_time", true}, {"sensor_frame", std::string("base")}}), "none");
}

TEST(SegmenterSettings, TakeTheHeightOfTheSensor) {
  const SegmenterSettings settings({{"sensor", std::string("vlp-16")}});

  EXPECT_THAT(settings.values().at("sensor_height"),
              VariantWith<double>(flagstone::Sensor::named("vlp-16").height));
}

TEST(SegmenterSettings, FollowTheSensorHeight) {
  const ParameterValues sensor = {{"method", std::string("patchwork")},
                                  {"sensor", std::string("hdl-64e")}};
  ParameterValues lower = sensor;
  lower["sensor_height"] = 0.6;

  EXPECT_NE(SegmenterSettings(lower).values(), SegmenterSettings(sensor).values());
  lower.erase("sensor_height");
  EXPECT_EQ(SegmenterSettings(lower).values(), SegmenterSettings(sensor).values());
}

TEST(SegmenterSettings, AcceptTheSensorHeightAsNumberIntegerOrWord) {
  EXPECT_THAT(SegmenterSettings({{"sensor_height", std::int64_t{2}}}).values().at("sensor_height"),
              VariantWith<double>(2));
  EXPECT_THAT(SegmenterSettings({{"sensor_height", 0.65}}).values().at("sensor_height"),
              VariantWith<double>(0.65));
  const SegmenterSettings tracked({{"sensor_height", std::string("track")}});
  EXPECT_THAT(tracked.values().at("sensor_height"), VariantWith<std::string>("track"));
  EXPECT_TRUE(tracked.estimates_mount());
}

TEST(SegmenterSettings, AcceptTheTiltAsWordOrDirection) {
  const std::vector<double> up = {0, 0.5, 1};

  EXPECT_THAT(SegmenterSettings({{"tilt", up}}).values().at("tilt"),
              VariantWith<std::vector<double>>(ElementsAre(0, 0.5, 1)));
  EXPECT_TRUE(SegmenterSettings({{"tilt", std::string("estimate")}}).estimates_mount());
  const SegmenterSettings imu({{"tilt", std::string("imu")}});
  EXPECT_TRUE(imu.uses_imu());
  EXPECT_THAT(imu.values().at("tilt"), VariantWith<std::string>("imu"));
}

TEST(SegmenterSettings, AreReadFromAFileAndOverriddenByParameters) {
  const std::string file = ::testing::TempDir() + "/component_settings.toml";
  std::ofstream(file) << "sensor_height = 0.9\n[point]\nmargin = 0.25\n[mount]\ntilt = \"fixed\"\n";

  const ParameterValues values =
      SegmenterSettings({{"config", file}, {"point.margin", 0.3}}).values();

  EXPECT_THAT(values.at("sensor_height"), VariantWith<double>(0.9));
  EXPECT_THAT(values.at("point.margin"), VariantWith<double>(0.3));
  EXPECT_THAT(values.at("tilt"), VariantWith<std::vector<double>>(ElementsAre(0, 0, 1)));
}

TEST(SegmenterSettings, RejectInvalidValuesWithNameAndReason) {
  EXPECT_THAT(reason({{"method", std::string("ransac")}}),
              StartsWith("method: 'ransac' is not a method (expected surface or patchwork)"));
  EXPECT_THAT(reason({{"sensor_height", std::string("high")}}),
              StartsWith("sensor_height: 'high' is not a height"));
  EXPECT_THAT(reason({{"sensor_height", true}}), StartsWith("sensor_height: has the wrong type"));
  EXPECT_THAT(reason({{"sensor_height", 1000.0}}), HasSubstr("expected -100 to 100 m"));
  EXPECT_THAT(reason({{"tilt", std::string("left")}}), StartsWith("tilt: 'left' is not a tilt"));
  EXPECT_THAT(reason({{"tilt", std::vector<double>{1, 2}}}),
              StartsWith("tilt: has the wrong type"));
  EXPECT_THAT(reason({{"threads", std::int64_t{0}}}), StartsWith("threads: 0 is out of range"));
  EXPECT_THAT(reason({{"point.margin", 11.0}}), HasSubstr("point.margin = 11 is out of range"));
  EXPECT_THAT(reason({{"point.margin", std::string("a")}}),
              HasSubstr("point.margin must be a number"));
  EXPECT_THAT(reason({{"sensor", std::string("unknown-64")}}), HasSubstr("unknown-64"));
  EXPECT_THAT(reason({{"config", std::string("/missing.toml")}}), HasSubstr("/missing.toml"));
  EXPECT_THAT(reason({{"preset", std::string("paper")}}), HasSubstr("has no presets"));
}

TEST(SegmenterSettings, ReadTheDeclaredParametersOfTheSegmenter) {
  for (const NodeParameter& parameter : node_parameters) {
    const bool is_of_node = parameter.name == "input_type" || parameter.name == "sensor_frame" ||
                            parameter.name == "imu_time_constant" ||
                            parameter.name == "queue_depth" ||
                            parameter.name == "diagnostics_period";
    EXPECT_EQ(is_segmenter_parameter(parameter.name), !is_of_node) << parameter.name;
  }
}

}  // namespace
}  // namespace flagstone_ros
