// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/mount/mount_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

namespace flagstone {
namespace {

using testing::HasSubstr;

/// The error message of check(); empty if the settings are valid.
std::string complaint(const MountSettings& settings) {
  try {
    settings.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MountSettings, DefaultsAreValidAndEstimateNothing) {
  EXPECT_EQ(complaint({}), "");
  EXPECT_FALSE(MountSettings{}.estimates());
  EXPECT_FALSE(MountSettings{}.tracks());
}

TEST(MountSettings, EveryNumberHasARange) {
  for (std::size_t i = 0; i < settings_of(*std::make_unique<MountSettings>()).size(); ++i) {
    MountSettings settings;
    const Setting setting = settings_of(settings)[i];
    if (auto* const* number = std::get_if<float*>(&setting.value)) {
      **number = std::numeric_limits<float>::quiet_NaN();
    } else if (auto* const* count = std::get_if<int*>(&setting.value)) {
      **count = -1;
    } else if (auto* const* vector = std::get_if<std::array<float, 3>*>(&setting.value)) {
      (**vector)[1] = 1e9f;
    } else {
      std::get<Choice>(setting.value).choose(7);
    }

    EXPECT_THAT(complaint(settings), HasSubstr(std::string(setting.key)));
  }
}

TEST(MountSettings, RejectsAnUpOfLengthZero) {
  MountSettings settings;
  settings.mount.up = {0, 0, 0};

  EXPECT_THAT(complaint(settings), HasSubstr("length of mount.up = 0"));
}

TEST(MountSettings, RejectsASensorHeightOutOfRange) {
  MountSettings settings;
  settings.mount.sensor_height = 101;

  EXPECT_THAT(complaint(settings), HasSubstr("sensor_height = 101"));
}

TEST(MountSettings, RejectsContradictoryLimits) {
  MountSettings heights;
  heights.limits.max_height = heights.limits.min_height;
  MountSettings ranges;
  ranges.limits.ego_radius = 12;

  EXPECT_THAT(complaint(heights), HasSubstr("above min_height"));
  EXPECT_THAT(complaint(ranges), HasSubstr("1.5 times ego_radius"));
}

TEST(MountSettings, AnEstimatorRejectsSettingsOutOfRange) {
  MountSettings settings;
  settings.limits.reach = 1;

  EXPECT_THROW(MountEstimator{settings}, std::invalid_argument);
}

}  // namespace
}  // namespace flagstone
