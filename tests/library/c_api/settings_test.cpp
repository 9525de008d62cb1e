// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "flagstone/make_segmenter.hpp"
#include "library/c_api/owned_handles.hpp"
#include "library/core/setting.hpp"
#include "library/methods/method.hpp"
#include "library/mount/mount_settings.hpp"
#include "numbers.hpp"

namespace flagstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::OwnedSettings;
using tests::settings_of;

flagstone_setting found(const OwnedSettings& settings, const char* name) {
  flagstone_setting setting{};
  flagstone_error error;
  EXPECT_EQ(flagstone_settings_find(settings.get(), name, &setting, &error), FLAGSTONE_OK)
      << error.message;
  return setting;
}

/// The message of the error that a segmenter with these settings reports.
std::string rejection_of(const OwnedSettings& settings) {
  flagstone_segmenter* segmenter = nullptr;
  flagstone_error error;
  EXPECT_EQ(flagstone_segmenter_create_with(settings.get(), 1, &segmenter, &error),
            FLAGSTONE_INVALID_ARGUMENT);
  EXPECT_EQ(segmenter, nullptr);
  return error.message;
}

class CSettings : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(AllMethods, CSettings, testing::Values("surface", "patchwork"),
                         [](const auto& method) { return std::string(method.param); });

TEST_P(CSettings, ListTheSettingsOfTheMethodThenOfTheMountingPose) {
  MethodConfig config = default_config(GetParam());
  MountSettings mount;
  std::vector<Setting> expected = config.settings();
  for (const Setting& setting : settings_of(mount)) expected.push_back(setting);
  const OwnedSettings settings = settings_of(GetParam());

  ASSERT_EQ(flagstone_settings_count(settings.get()), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    flagstone_setting setting{};
    ASSERT_EQ(flagstone_settings_at(settings.get(), i, &setting, nullptr), FLAGSTONE_OK);
    EXPECT_EQ(setting.name, expected[i].key);
    EXPECT_EQ(setting.meaning, expected[i].meaning);
    EXPECT_EQ(setting.unit, expected[i].allowed.unit);
    EXPECT_EQ(found(settings, setting.name).name, setting.name);
  }
}

TEST(CSettingsByName, DescribeEachType) {
  const OwnedSettings surface = settings_of("surface");
  const OwnedSettings patchwork = settings_of("patchwork");

  const flagstone_setting gate = found(surface, "refinement.gate");
  EXPECT_EQ(gate.type, FLAGSTONE_NUMBER);
  EXPECT_EQ(gate.number, 0.45f);
  EXPECT_EQ(gate.minimum, 0);
  EXPECT_TRUE(gate.excludes_minimum);
  EXPECT_EQ(gate.maximum, 10);
  EXPECT_FALSE(gate.allows_infinity);
  EXPECT_STREQ(gate.unit, "m");
  EXPECT_EQ(gate.numbers, nullptr);
  EXPECT_EQ(gate.choice, nullptr);

  const flagstone_setting levels = found(surface, "refinement.levels");
  EXPECT_EQ(levels.type, FLAGSTONE_INTEGER);
  EXPECT_EQ(levels.number, 4);
  EXPECT_STREQ(levels.unit, "");

  const flagstone_setting final_set = found(patchwork, "evaluate_final_set");
  EXPECT_EQ(final_set.type, FLAGSTONE_BOOLEAN);
  EXPECT_EQ(final_set.number, 0);
  EXPECT_EQ(final_set.maximum, 1);

  const flagstone_setting thresholds = found(patchwork, "flatness.thresholds");
  EXPECT_EQ(thresholds.type, FLAGSTONE_NUMBERS);
  EXPECT_THAT(std::vector<float>(thresholds.numbers, thresholds.numbers + thresholds.number_count),
              ElementsAre(0.0005f, 0.000725f, 0.001f));

  const flagstone_setting tilt = found(surface, "mount.tilt");
  EXPECT_EQ(tilt.type, FLAGSTONE_CHOICE);
  EXPECT_STREQ(tilt.choice, "off");
  EXPECT_TRUE(found(surface, "acceptance.max_clutter_ratio").allows_infinity);
}

TEST(CSettingsByName, ListTheNamesOfAChoice) {
  const OwnedSettings settings = settings_of("surface");

  EXPECT_STREQ(flagstone_settings_choice(settings.get(), "mount.height", 0), "fixed");
  EXPECT_STREQ(flagstone_settings_choice(settings.get(), "mount.height", 2), "track");
  EXPECT_EQ(flagstone_settings_choice(settings.get(), "mount.height", 3), nullptr);
  EXPECT_EQ(flagstone_settings_choice(settings.get(), "max_range", 0), nullptr);
  EXPECT_EQ(flagstone_settings_choice(settings.get(), "no", 0), nullptr);
}

TEST(CSettingsByName, AreSetByName) {
  const OwnedSettings settings = settings_of("patchwork");
  const std::array<float, 3> up = {0.1f, 0, 1};
  const std::array<float, 2> thresholds = {0.1f, 0.2f};

  EXPECT_EQ(flagstone_settings_set_number(settings.get(), "sensor_height", 2.5, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_settings_set_number(settings.get(), "iterations", 5, nullptr), FLAGSTONE_OK);
  EXPECT_EQ(flagstone_settings_set_number(settings.get(), "elevation.enabled", 0, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_settings_set_numbers(settings.get(), "mount.up", up.data(), 3, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_settings_set_numbers(settings.get(), "flatness.thresholds", thresholds.data(),
                                           2, nullptr),
            FLAGSTONE_OK);
  EXPECT_EQ(flagstone_settings_set_choice(settings.get(), "mount.tilt", "fixed", nullptr),
            FLAGSTONE_OK);

  EXPECT_EQ(found(settings, "sensor_height").number, 2.5);
  EXPECT_EQ(found(settings, "iterations").number, 5);
  EXPECT_EQ(found(settings, "elevation.enabled").number, 0);
  EXPECT_EQ(found(settings, "mount.up").numbers[0], 0.1f);
  EXPECT_EQ(found(settings, "flatness.thresholds").number_count, 2U);
  EXPECT_STREQ(found(settings, "mount.tilt").choice, "fixed");
}

TEST(CSettingsByName, OfAPresetEqualTheCppPreset) {
  flagstone_settings* handle = nullptr;
  ASSERT_EQ(flagstone_settings_create_for_preset("patchwork", "paper", &handle, nullptr),
            FLAGSTONE_OK);
  const OwnedSettings settings(handle);

  EXPECT_EQ(found(settings, "distance_margin").number,
            PatchworkConfig::preset("paper").distance_margin);
  EXPECT_NE(found(settings, "distance_margin").number, PatchworkConfig().distance_margin);
  ASSERT_EQ(flagstone_settings_create_for_preset("surface", "default", &handle, nullptr),
            FLAGSTONE_OK);
  flagstone_settings_destroy(handle);
}

TEST(CSettingsByName, ForASensorEqualTheResultOfTheCppFunction) {
  flagstone_settings* handle = nullptr;
  ASSERT_EQ(flagstone_settings_create_for_sensor("patchwork", "vlp-16", nan, &handle, nullptr),
            FLAGSTONE_OK);
  const OwnedSettings usual(handle);
  ASSERT_EQ(flagstone_settings_create_for_sensor("surface", "vlp-16", 0.6f, &handle, nullptr),
            FLAGSTONE_OK);
  const OwnedSettings low(handle);

  const PatchworkConfig expected = PatchworkConfig::for_sensor("vlp-16");
  EXPECT_EQ(found(usual, "sensor_height").number, expected.sensor_height);
  EXPECT_EQ(found(usual, "min_range").number, expected.min_range);
  EXPECT_EQ(found(low, "sensor_height").number, 0.6f);
}

TEST(CSettingsByName, OutOfRangeAreReportedWhenASegmenterIsCreated) {
  const OwnedSettings settings = settings_of("surface");
  const auto set = [&](const char* name, double value) {
    EXPECT_EQ(flagstone_settings_set_number(settings.get(), name, value, nullptr), FLAGSTONE_OK);
  };

  set("sensor_height", 1000);
  EXPECT_EQ(rejection_of(settings),
            "surface: sensor_height = 1000 is out of range (expected -100 to 100 m)");
  set("sensor_height", nan);
  EXPECT_THAT(rejection_of(settings), HasSubstr("sensor_height = nan"));
  set("sensor_height", 1.73);
  set("refinement.levels", 1e300);
  EXPECT_THAT(rejection_of(settings), HasSubstr("refinement.levels = 2.14748e+09"));
  set("refinement.levels", 4);
  set("point.margin", -1e300);
  EXPECT_THAT(rejection_of(settings), HasSubstr("point.margin = -3.40282e+38"));
  set("point.margin", 0.24);
  set("mount.scale", 0);
  EXPECT_THAT(rejection_of(settings), HasSubstr("mount.scale = 0"));
}

/// A call that fails, and its message.
struct Fault {
  const char* name;
  flagstone_status (*call)(flagstone_settings* settings, flagstone_error* error);
  const char* message;
};

class CSettingsFault : public testing::TestWithParam<Fault> {};

constexpr std::array<float, 3> three = {0, 0, 1};
INSTANTIATE_TEST_SUITE_P(
    AllFaults, CSettingsFault,
    testing::Values(
        Fault{"UnknownSetting",
              [](auto* s, auto* e) { return flagstone_settings_set_number(s, "min_rang", 1, e); },
              "settings: no setting 'min_rang' (did you mean 'min_range'?)"},
        Fault{"UnknownArray",
              [](auto* s, auto* e) {
                return flagstone_settings_set_numbers(s, "x", three.data(), 3, e);
              },
              "settings: no setting 'x' (flagstone_settings_at() lists them)"},
        Fault{"UnknownChoice",
              [](auto* s, auto* e) { return flagstone_settings_set_choice(s, "x", "off", e); },
              "settings: no setting 'x' (flagstone_settings_at() lists them)"},
        Fault{
            "Fraction",
            [](auto* s, auto* e) { return flagstone_settings_set_number(s, "iterations", 2.5, e); },
            "iterations: has another type (expected an integer)"},
        Fault{
            "NanForAnInteger",
            [](auto* s, auto* e) { return flagstone_settings_set_number(s, "iterations", nan, e); },
            "iterations: has another type (expected an integer)"},
        Fault{"TwoForABoolean",
              [](auto* s, auto* e) {
                return flagstone_settings_set_number(s, "evaluate_final_set", 2, e);
              },
              "evaluate_final_set: has another type (expected 0 or 1)"},
        Fault{"NumberForAnArray",
              [](auto* s, auto* e) {
                return flagstone_settings_set_number(s, "flatness.thresholds", 2, e);
              },
              "flatness.thresholds: has another type (expected an array of numbers)"},
        Fault{"NumberForAChoice",
              [](auto* s, auto* e) { return flagstone_settings_set_number(s, "mount.tilt", 2, e); },
              "mount.tilt: has another type (expected the name of a choice)"},
        Fault{"ArrayForANumber",
              [](auto* s, auto* e) {
                return flagstone_settings_set_numbers(s, "min_range", three.data(), 1, e);
              },
              "min_range: has another type (expected a number)"},
        Fault{"ShortArray",
              [](auto* s, auto* e) {
                return flagstone_settings_set_numbers(s, "mount.up", three.data(), 2, e);
              },
              "mount.up: has another type (expected an array of three numbers)"},
        Fault{"ChoiceForABoolean",
              [](auto* s, auto* e) {
                return flagstone_settings_set_choice(s, "evaluate_final_set", "true", e);
              },
              "evaluate_final_set: has another type (expected 0 or 1)"},
        Fault{
            "NotOneOfTheNames",
            [](auto* s, auto* e) {
              return flagstone_settings_set_choice(s, "mount.tilt", "fixd", e);
            },
            "no mount.tilt is named 'fixd' (expected off, fixed, estimate; did you mean 'fixed'?)"},
        Fault{"IndexBeyondTheLast",
              [](auto* s, auto* e) {
                flagstone_setting setting;
                return flagstone_settings_at(s, 1000, &setting, e);
              },
              "index: 1000 is out of range (expected less than "},
        Fault{"UnknownMethod",
              [](auto*, auto* e) {
                flagstone_settings* created = nullptr;
                return flagstone_settings_create("surfce", &created, e);
              },
              "no method is named 'surfce' (expected patchwork, surface; did you mean 'surface'?)"},
        Fault{"UnknownPreset",
              [](auto*, auto* e) {
                flagstone_settings* created = nullptr;
                return flagstone_settings_create_for_preset("patchwork", "papr", &created, e);
              },
              "papr"},
        Fault{"PresetOfAMethodWithoutPresets",
              [](auto*, auto* e) {
                flagstone_settings* created = nullptr;
                return flagstone_settings_create_for_preset("surface", "paper", &created, e);
              },
              "method surface: has no preset 'paper' (expected default)"},
        Fault{"UnknownSensor",
              [](auto*, auto* e) {
                flagstone_settings* created = nullptr;
                return flagstone_settings_create_for_sensor("surface", "vlp16", nan, &created, e);
              },
              "did you mean 'vlp-16'?"},
        Fault{"SensorBelowTheGround",
              [](auto*, auto* e) {
                flagstone_settings* created = nullptr;
                return flagstone_settings_create_for_sensor("surface", "vlp-16", -1, &created, e);
              },
              "height = -1 is out of range"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST_P(CSettingsFault, IsReportedAndChangesNothing) {
  const OwnedSettings settings = settings_of("patchwork");
  const OwnedSettings unchanged = settings_of("patchwork");
  flagstone_error error;

  EXPECT_EQ(GetParam().call(settings.get(), &error), FLAGSTONE_INVALID_ARGUMENT);

  EXPECT_THAT(std::string(error.message), HasSubstr(GetParam().message));
  for (std::size_t i = 0; i < flagstone_settings_count(settings.get()); ++i) {
    flagstone_setting before{};
    flagstone_setting after{};
    flagstone_settings_at(unchanged.get(), i, &before, nullptr);
    flagstone_settings_at(settings.get(), i, &after, nullptr);
    EXPECT_EQ(after.number, before.number);
    EXPECT_EQ(after.number_count, before.number_count);
    EXPECT_EQ(after.choice, before.choice);
  }
}

}  // namespace
}  // namespace flagstone
