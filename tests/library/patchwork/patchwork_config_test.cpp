// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "flagstone/patchwork_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>

#include "flagstone/patchwork.hpp"
#include "numbers.hpp"

namespace flagstone {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The error message of check() after `spoil`; empty if the configuration is valid.
std::string complaint(const std::function<void(PatchworkConfig&)>& spoil) {
  PatchworkConfig config;
  spoil(config);
  try {
    config.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(PatchworkConfig, EveryPresetIsValid) {
  for (const std::string_view name : PatchworkConfig::preset_names()) {
    EXPECT_NO_THROW(PatchworkConfig::preset(name).check()) << name;
  }
}

TEST(PatchworkConfig, RejectsAnUnknownPresetAndListsThePresets) {
  try {
    PatchworkConfig::preset("best");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("best"));
    for (const std::string_view name : PatchworkConfig::preset_names()) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(name)));
    }
  }
}

TEST(PatchworkConfig, RejectsABadValueAndNamesFieldValueAndRange) {
  const std::string message = complaint([](auto& c) { c.distance_margin = -0.25f; });

  EXPECT_THAT(message, HasSubstr("distance_margin"));
  EXPECT_THAT(message, HasSubstr("-0.25"));
  EXPECT_THAT(message, HasSubstr("above 0, up to 100 m"));
}

TEST(PatchworkConfig, IsCheckedByTheConstructorOfPatchwork) {
  EXPECT_THROW(Patchwork({.sensor_height = nan}), std::invalid_argument);
}

TEST(PatchworkConfig, EveryFieldHasARange) {
  using Config = PatchworkConfig;
  const std::vector<std::pair<std::string, std::function<void(Config&)>>> spoilers = {
      {"sensor_height", [](Config& c) { c.sensor_height = 101; }},
      {"sensor_height", [](Config& c) { c.sensor_height = nan; }},
      {"min_range", [](Config& c) { c.min_range = -1; }},
      {"number of zones", [](Config& c) { c.zones.clear(); }},
      {"number of zones", [](Config& c) { c.zones.resize(17, c.zones[0]); }},
      {"zones[0].ring_radii", [](Config& c) { c.zones[0].ring_radii.clear(); }},
      {"zones[0].ring_radii[0]", [](Config& c) { c.zones[0].ring_radii[0] = c.min_range; }},
      {"zones[1].ring_radii[0]", [](Config& c) { c.zones[1].ring_radii[0] = 5; }},
      {"zones[3].ring_radii[4]", [](Config& c) { c.zones[3].ring_radii[4] = 1001; }},
      {"zones[2].ring_radii[1]", [](Config& c) { c.zones[2].ring_radii[1] = nan; }},
      {"zones[0].sectors", [](Config& c) { c.zones[0].sectors = 0; }},
      {"zones[0].sectors", [](Config& c) { c.zones[0].sectors = 3601; }},
      {"zones[0].height_margin", [](Config& c) { c.zones[0].height_margin = -1; }},
      {"zones[0].height_margin", [](Config& c) { c.zones[0].height_margin = nan; }},
      {"number of bins", [](Config& c) { c.zones = {{equal_rings(2.7f, 80, 100), 3600, -1.1f}}; }},
      {"noise_depth", [](Config& c) { c.noise_depth = -0.1f; }},
      {"noise_slope", [](Config& c) { c.noise_slope = 11; }},
      {"min_points", [](Config& c) { c.min_points = 2; }},
      {"seed_count", [](Config& c) { c.seed_count = 0; }},
      {"seed_height", [](Config& c) { c.seed_height = 0; }},
      {"distance_margin", [](Config& c) { c.distance_margin = inf; }},
      {"noise_margin", [](Config& c) { c.noise_margin = 0; }},
      {"lower_plane_margin", [](Config& c) { c.lower_plane_margin = 0; }},
      {"iterations", [](Config& c) { c.iterations = 0; }},
      {"uprightness.angle", [](Config& c) { c.uprightness.angle = 91; }},
      {"elevation.base", [](Config& c) { c.elevation.base = -1; }},
      {"elevation.growth", [](Config& c) { c.elevation.growth = 2; }},
      {"elevation.range", [](Config& c) { c.elevation.range = nan; }},
      {"elevation.scale", [](Config& c) { c.elevation.scale = 0; }},
      {"flatness.gain", [](Config& c) { c.flatness.gain = 1; }},
      {"flatness.thresholds", [](Config& c) { c.flatness.thresholds.clear(); }},
      {"flatness.thresholds[0]", [](Config& c) { c.flatness.thresholds[0] = 0.5f; }},
      {"flatness.scale", [](Config& c) { c.flatness.scale = -1; }},
  };
  for (const auto& [field, spoil] : spoilers) EXPECT_THAT(complaint(spoil), HasSubstr(field));
}

TEST(PatchworkConfig, NoiseDepthAndHeightMarginCanBeInfinite) {
  EXPECT_EQ(complaint([](auto& c) {
              c.noise_depth = inf;
              c.zones[0].height_margin = -inf;
            }),
            "");
}

TEST(EqualRings, HaveTheWidthsOfThePaper) {
  EXPECT_THAT(equal_rings(2, 10, 4), ElementsAre(4, 6, 8, 10));
}

TEST(Presets, ThePaperHas504BinsBetweenItsBoundaries) {
  const PatchworkConfig paper = PatchworkConfig::preset("paper");

  std::size_t bins = 0;
  std::vector<float> boundaries;
  for (const Zone& zone : paper.zones) {
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
    boundaries.push_back(zone.ring_radii.back());
  }

  EXPECT_EQ(bins, 504u);
  EXPECT_EQ(paper.min_range, 2.7f);
  EXPECT_THAT(boundaries, ElementsAre(testing::FloatEq(12.3625f), testing::FloatEq(22.025f),
                                      testing::FloatEq(41.35f), testing::FloatEq(80)));
}

TEST(Presets, TheReferenceHas544Bins) {
  std::size_t bins = 0;
  for (const Zone& zone : PatchworkConfig::preset("reference").zones) {
    bins += zone.ring_radii.size() * static_cast<std::size_t>(zone.sectors);
  }

  EXPECT_EQ(bins, 544u);
}

TEST(Presets, HaveTheTermsOfThePaperAndOfThePublicCode) {
  const PatchworkConfig paper = PatchworkConfig::preset("paper");
  const PatchworkConfig reference = PatchworkConfig::preset("reference");

  EXPECT_EQ(paper.elevation.range, 22.025f);
  EXPECT_EQ(paper.flatness.gain, 1.2f);
  EXPECT_THAT(paper.flatness.thresholds, ElementsAre(0.00012f, 0.00012f, 0.0002f));
  EXPECT_EQ(reference.elevation.range, 13.266f);
  EXPECT_EQ(reference.flatness.gain, 1.2f);
  EXPECT_THAT(reference.flatness.thresholds, ElementsAre(0.0005f, 0.000725f, 0.001f));
}

TEST(Presets, ThePaperHasAHeightMarginThatLoosensOutwards) {
  const std::vector<Zone> zones = PatchworkConfig::preset("paper").zones;

  EXPECT_EQ(zones[0].height_margin, -1.1f);
  for (std::size_t m = 1; m < zones.size(); ++m) {
    EXPECT_LT(zones[m].height_margin, zones[m - 1].height_margin);
  }
}

}  // namespace
}  // namespace flagstone
