// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/config/config_toml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/config/same_config.hpp"
#include "numbers.hpp"

namespace flagstone::config {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

/// Any float except NaN, including denormals, infinities and the largest values.
rc::Gen<float> any_number() {
  return rc::gen::suchThat(
      rc::gen::map(rc::gen::arbitrary<std::uint32_t>(),
                   [](std::uint32_t bits) { return std::bit_cast<float>(bits); }),
      [](float value) { return !std::isnan(value); });
}

rc::Gen<std::vector<float>> any_numbers() {
  return rc::gen::container<std::vector<float>>(any_number());
}

/// A configuration of any values. They are written in the same way whether they are in range or
/// not.
PatchworkConfig any_config() {
  PatchworkConfig c;
  for (float* value :
       {&c.sensor_height, &c.min_range, &c.noise_depth, &c.noise_slope, &c.seed_height,
        &c.distance_margin, &c.noise_margin, &c.lower_plane_margin, &c.uprightness.angle,
        &c.elevation.base, &c.elevation.growth, &c.elevation.range, &c.elevation.scale,
        &c.flatness.gain, &c.flatness.scale}) {
    *value = *any_number();
  }
  for (int* value : {&c.min_points, &c.seed_count, &c.iterations}) {
    *value = *rc::gen::inRange(-std::numeric_limits<int>::max(), std::numeric_limits<int>::max());
  }
  for (bool* value : {&c.sparse_bins_are_ground, &c.keep_below_margin, &c.evaluate_final_set,
                      &c.uprightness.enabled, &c.elevation.enabled, &c.flatness.enabled}) {
    *value = *rc::gen::arbitrary<bool>();
  }
  c.flatness.thresholds = *any_numbers();
  c.zones.resize(*rc::gen::inRange<std::size_t>(1, 6));
  for (Zone& zone : c.zones) {
    zone = {*any_numbers(), *rc::gen::arbitrary<std::uint16_t>(), *any_number()};
  }
  return c;
}

void apply_toml(std::string_view text, std::string_view source, PatchworkConfig& config) {
  MethodConfig any = config;
  MountSettings mount;
  config::apply_toml(text, source, any, mount);
  config = *any.get_if<PatchworkConfig>();
}

/// The error message of apply_toml; empty if there is none.
std::string complaint(const std::string& text) {
  PatchworkConfig config;
  try {
    apply_toml(text, "mine.toml", config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// One line that starts with source, line and column and contains `reason`.
auto points_at(int line, int column, const std::string& reason) {
  return AllOf(StartsWith("mine.toml: line " + std::to_string(line) + ", column " +
                          std::to_string(column) + ": "),
               HasSubstr(reason), Not(HasSubstr("\n")));
}

TEST(ConfigToml, EveryPresetReadsBackUnchangedOverAnyOther) {
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    for (const std::string_view other : PatchworkConfig::preset_names()) {
      const PatchworkConfig written = PatchworkConfig::preset(name);
      PatchworkConfig read = PatchworkConfig::preset(other);

      apply_toml(to_toml(written), "preset", read);

      EXPECT_TRUE(is_same(read, written)) << name << " over " << other;
    }
  }
}

RC_GTEST_PROP(ConfigToml, AnyConfigurationReadsBackUnchanged, ()) {
  const PatchworkConfig written = any_config();
  PatchworkConfig read;

  apply_toml(to_toml(written), "any", read);

  RC_ASSERT(is_same(read, written));
}

TEST(ConfigToml, EverySettingHasAComment) {
  const std::string text = to_toml(PatchworkConfig{});

  EXPECT_THAT(text,
              ContainsRegex("\ndistance_margin = 0.125  # M_d: [^\n]+; above 0, up to 100 m\n"));
  EXPECT_THAT(text, ContainsRegex("\n.elevation.\nenabled = true  # [^\n]+ psi, eq"));
  EXPECT_THAT(text, HasSubstr("\n[[zones]]\n"));
}

TEST(ConfigToml, LeavesOtherSettingsUnchanged) {
  PatchworkConfig config = PatchworkConfig::preset("paper");
  PatchworkConfig expected = config;
  expected.seed_count = 7;
  expected.flatness.enabled = false;

  apply_toml("seed_count = 7\n[flatness]\nenabled = false\n", "mine.toml", config);

  EXPECT_TRUE(is_same(config, expected));
}

TEST(ConfigToml, AcceptsAnIntegerForAFloat) {
  PatchworkConfig config;

  apply_toml("sensor_height = 2", "mine.toml", config);

  EXPECT_EQ(config.sensor_height, 2.0f);
}

TEST(ConfigToml, ReplacesZonesAsAWhole) {
  PatchworkConfig config;

  apply_toml("[[zones]]\nring_radii = [10, 20.5]\nsectors = 8\nheight_margin = -inf\n", "mine.toml",
             config);

  ASSERT_THAT(config.zones, SizeIs(1));
  EXPECT_THAT(config.zones[0].ring_radii, ElementsAre(10.0f, 20.5f));
  EXPECT_EQ(config.zones[0].sectors, 8);
  EXPECT_EQ(config.zones[0].height_margin, -inf);
}

TEST(ConfigToml, OnlyInfIsInfinite) {
  PatchworkConfig config;

  apply_toml("noise_depth = inf\nnoise_margin = 1e300", "mine.toml", config);

  EXPECT_EQ(config.noise_depth, inf);
  EXPECT_THROW(config.check(), std::invalid_argument);
}

TEST(ConfigToml, RejectsAnIntegerThatIsTooLargeInsteadOfWrapping) {
  PatchworkConfig config;

  apply_toml("iterations = 4294967299", "mine.toml", config);  // 2^32 + 3

  EXPECT_THROW(config.check(), std::invalid_argument);
}

TEST(ConfigToml, RejectsAnUnknownSettingWithItsPosition) {
  EXPECT_THAT(complaint("seed_count = 7\nseed_cuont = 8\n"), points_at(2, 14, "seed_cuont"));
  EXPECT_THAT(complaint("[elevation]\nwidth = 8\n"), points_at(2, 9, "elevation.width"));
  EXPECT_THAT(complaint("[walls]\nenabled = true\n"), points_at(1, 1, "walls"));
  EXPECT_THAT(complaint("elevation = 3\n"), points_at(1, 13, "elevation"));
  EXPECT_THAT(complaint("\"two\\nlines\" = 3\n"), points_at(1, 16, R"(two\x0alines)"));
  EXPECT_THAT(complaint("[[zones]]\nrings = 3\n"), points_at(2, 9, "zones[0].rings"));
}

TEST(ConfigToml, RejectsAValueOfTheWrongTypeWithItsPosition) {
  EXPECT_THAT(complaint("\nseed_height = \"low\"\n"),
              points_at(2, 15, "seed_height must be a number, got a string"));
  EXPECT_THAT(complaint("iterations = 3.5\n"),
              points_at(1, 14, "iterations must be an integer, got a floating-point number"));
  EXPECT_THAT(complaint("evaluate_final_set = 1\n"),
              points_at(1, 22, "evaluate_final_set must be true or false, got an integer"));
  EXPECT_THAT(complaint("flatness.thresholds = 0.1\n"),
              points_at(1, 23, "flatness.thresholds must be an array of numbers"));
  EXPECT_THAT(complaint("flatness.thresholds = [0.1, true]\n"),
              points_at(1, 29, "flatness.thresholds must be a number, got a boolean"));
  EXPECT_THAT(complaint("zones = 3\n"), points_at(1, 9, "zones must be an array of tables"));
  EXPECT_THAT(complaint("zones = [3]\n"), points_at(1, 10, "zones[0] must be a table"));
}

TEST(ConfigToml, RejectsASyntaxErrorWithItsPosition) {
  EXPECT_THAT(complaint("iterations = 3\nseed_count 7\n"), points_at(2, 12, "Error"));
  EXPECT_THAT(complaint("iterations = \n"), points_at(1, 14, "Error"));
  EXPECT_THAT(complaint("iterations = 3\niterations = 4\n"), points_at(2, 14, "iterations"));
}

RC_GTEST_PROP(ConfigToml, AnyTextIsReadOrRejectedOnOneLine, ()) {
  const auto text = *rc::gen::container<std::string>(rc::gen::oneOf(
      rc::gen::arbitrary<char>(), rc::gen::elementOf(std::string("[]{}=.\"\n a1#"))));

  const std::string message = complaint(text);

  RC_ASSERT(message.empty() || message.starts_with("mine.toml: line "));
  RC_ASSERT(message.find('\n') == std::string::npos);
}

}  // namespace
}  // namespace flagstone::config
