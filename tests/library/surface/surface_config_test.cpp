// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/surface_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "flagstone/surface.hpp"
#include "library/core/setting.hpp"
#include "library/surface/surface_settings.hpp"
#include "random_cloud.hpp"

namespace flagstone {
namespace {

/// Sets the setting with index `setting` to `value`.
void set(SurfaceConfig& config, std::size_t setting, double value) {
  const Setting chosen = settings_of(config)[setting];
  if (float* const* number = std::get_if<float*>(&chosen.value)) {
    **number = static_cast<float>(value);
  }
  if (int* const* number = std::get_if<int*>(&chosen.value)) **number = static_cast<int>(value);
}

/// The error message of check() for a setting with this value; empty if the value is valid.
std::string error_of(std::size_t setting, double value) {
  SurfaceConfig config;
  set(config, setting, value);
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(SurfaceConfigCheck, AcceptsTheDefaults) { EXPECT_NO_THROW(SurfaceConfig().check()); }

TEST(SurfaceConfigCheck, RejectsEverySettingOutOfRange) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  SurfaceConfig config;
  const std::vector<Setting> settings = settings_of(config);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& [low, high, unit, exclusive_min, allow_infinity, remark] = settings[i].allowed;
    const std::string key(settings[i].key);
    EXPECT_EQ(error_of(i, high), "") << key;
    EXPECT_EQ(error_of(i, low).empty(), !exclusive_min) << key;
    for (const double value : {low - 1, high + 1}) {
      EXPECT_THAT(error_of(i, value), testing::HasSubstr("surface: " + key)) << value;
    }
    if (std::holds_alternative<int*>(settings[i].value)) continue;
    EXPECT_EQ(error_of(i, inf).empty(), allow_infinity) << key;
    EXPECT_THAT(error_of(i, std::nan("")), testing::HasSubstr(key));
  }
}

TEST(SurfaceConfigCheck, HeightsAreFiniteAtBothEndsOfEveryRange) {
  const std::vector<Point> cloud = tests::corrupted_cloud(6000, 1);
  SurfaceConfig initial;
  const std::size_t count = settings_of(initial).size();
  for (std::size_t i = 0; i < count; ++i) {
    for (const bool highest : {false, true}) {
      SurfaceConfig config;
      const Setting setting = settings_of(config)[i];
      const ValidRange& allowed = setting.allowed;
      const double lowest = allowed.exclusive_min ? 1e-6 : allowed.low;
      const double value = highest ? allowed.high : lowest;
      set(config, i, value);
      Surface segmenter(config);
      Segmentation result;

      ASSERT_TRUE(segmenter.segment(tests::view_of(cloud), result).ok());

      EXPECT_EQ(result.labels().size(), cloud.size());
      for (const GroundSurface::Grid& grid : result.surface().grids()) {
        for (std::size_t k = 0; k < grid.heights.size(); ++k) {
          ASSERT_FALSE(std::isinf(grid.heights[k])) << setting.key << " " << value;
          ASSERT_EQ(std::isnan(grid.heights[k]), grid.confidences[k] == 0)
              << setting.key << " " << value;
        }
      }
    }
  }
}

}  // namespace
}  // namespace flagstone
