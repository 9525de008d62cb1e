// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/core/setting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "library/core/did_you_mean.hpp"

namespace flagstone {
namespace {

constexpr ValidRange millionths = {.low = 1e-6, .high = 1e6};

bool is_refused(float value, const ValidRange& allowed) {
  try {
    check_settings("test", {{"scale", &value, "", allowed}});
  } catch (const std::invalid_argument&) {
    return true;
  }
  return false;
}

TEST(Setting, AcceptsLimitsRoundedToFloat) {
  for (const double bound : {1e-6, 0.1, 0.3, 1.0 / 3, 0.999999}) {
    const auto value = static_cast<float>(bound);
    EXPECT_FALSE(is_refused(value, {.low = bound, .high = 2})) << bound;
    EXPECT_FALSE(is_refused(value, {.low = -1, .high = bound})) << bound;
    EXPECT_TRUE(is_refused(value, {.low = bound, .high = 2, .exclusive_min = true})) << bound;
    EXPECT_TRUE(is_refused(std::nextafter(value, 2.0f), {.low = -1, .high = bound})) << bound;
    EXPECT_TRUE(is_refused(std::nextafter(value, -2.0f), {.low = bound, .high = 2})) << bound;
  }
}

TEST(Setting, PrintsLimitsWithoutExponents) {
  EXPECT_EQ(to_string(millionths), "0.000001 to 1000000");
  EXPECT_EQ(to_string({.low = 0, .high = 1.0 / 3}), "0 to 0.333333");
}

constexpr std::array<std::string_view, 4> names = {"sensor_height", "surface", "hdl-64e", "gpf"};

TEST(DidYouMean, SuggestsASimilarName) {
  EXPECT_EQ(did_you_mean("sensor_hight", names), " (did you mean 'sensor_height'?)");
  EXPECT_EQ(closest_name("surfcae", names), "surface");
  EXPECT_EQ(closest_name("HDL64E", names), "hdl-64e");
  EXPECT_EQ(closest_name("gfp", names), "gpf");
}

TEST(DidYouMean, IsEmptyIfNoNameIsSimilar) {
  EXPECT_EQ(did_you_mean("colour", names), "");
  EXPECT_EQ(did_you_mean("", names), "");
  EXPECT_EQ(did_you_mean(std::string(1000, 's'), names), "");
}

TEST(DidYouMean, AnUnknownNameIsReportedWithTheKnownNames) {
  EXPECT_EQ(
      no_such("method", "surfce", names),
      "no method is named 'surfce' (expected sensor_height, surface, hdl-64e, gpf; did you mean "
      "'surface'?)");
}

TEST(ToFloat, ClampsFiniteNumbersAndKeepsInfinityAndNan) {
  EXPECT_EQ(to_float(0.1), 0.1f);
  EXPECT_EQ(to_float(1e300), std::numeric_limits<float>::max());
  EXPECT_EQ(to_float(-1e300), -std::numeric_limits<float>::max());
  EXPECT_EQ(to_float(std::numeric_limits<double>::infinity()),
            std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(to_float(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace
}  // namespace flagstone
