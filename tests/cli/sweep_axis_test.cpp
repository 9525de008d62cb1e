// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "cli/sweep_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "app/config/same_config.hpp"

namespace flagstone::cli {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// What is said where `action` is refused.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was refused";
}

std::string refusal_of_value(const std::string& key, const std::string& value,
                             MethodConfig config = PatchworkConfig{}) {
  return refusal([&] { apply_axis(key, value, config); });
}

TEST(SweepAxis, IsAKeyAndItsValuesInTheirOrder) {
  const SweepAxis axis = sweep_axis("elevation.scale=0.5,0.1,0");

  EXPECT_EQ(axis.key, "elevation.scale");
  EXPECT_THAT(axis.values, ElementsAre("0.5", "0.1", "0"));
  EXPECT_THAT(sweep_axis("bins=30x108").values, ElementsAre("30x108"));
}

TEST(SweepAxis, WithoutKeyOrValuesIsRefusedWithAnExample) {
  for (const std::string text : {"", "seed_count", "seed_count=", "=3"}) {
    EXPECT_THAT(refusal([&] { static_cast<void>(sweep_axis(text)); }),
                AllOf(HasSubstr("--param " + text), HasSubstr("KEY=VALUE,VALUE")));
  }
}

TEST(SweepAxis, SetsOneSettingOfAnyMethod) {
  MethodConfig patchwork = PatchworkConfig{};
  MethodConfig gpf = GpfConfig{};

  apply_axis("uprightness.angle", "30", patchwork);
  apply_axis("segments", "5", gpf);

  PatchworkConfig expected;
  expected.uprightness.angle = 30;
  EXPECT_TRUE(is_same(std::get<PatchworkConfig>(patchwork), expected));
  EXPECT_EQ(std::get<GpfConfig>(gpf).segments, 5);
}

TEST(SweepAxis, BinsMakeOneZoneOfEqualRingsOutToWhereTheLastZoneEnded) {
  MethodConfig config = PatchworkConfig{};
  const PatchworkConfig before;

  apply_axis("bins", "4x36", config);

  const auto& made = std::get<PatchworkConfig>(config);
  ASSERT_EQ(made.zones.size(), 1U);
  EXPECT_EQ(made.zones[0].sectors, 36);
  const auto& radii = made.zones[0].ring_radii;
  ASSERT_EQ(radii.size(), 4U);
  const float outer = before.zones.back().ring_radii.back();
  const float width = (outer - before.min_range) / 4;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(radii[i], before.min_range + width * static_cast<float>(i + 1), 1e-4f);
  }
  EXPECT_EQ(radii.back(), outer);
}

TEST(SweepAxis, TheGridOfThePaperIsThatOfRGpf) {
  MethodConfig config = r_gpf_config();

  apply_axis("bins", "30x108", config);

  EXPECT_TRUE(is_same(std::get<PatchworkConfig>(config), r_gpf_config()));
}

TEST(SweepAxis, BinsThatAreNoGridAreRefused) {
  for (const std::string value :
       {"30", "x", "30x", "x108", "0x108", "30x0", "-3x108", "30x108x2", "30 x108", "1001x4"}) {
    EXPECT_THAT(refusal_of_value("bins", value),
                AllOf(HasSubstr("bins = " + value), HasSubstr("30x108")));
  }
}

TEST(SweepAxis, BinsOfAMethodWithoutZonesAreRefused) {
  EXPECT_THAT(refusal_of_value("bins", "30x108", GpfConfig{}), HasSubstr("of patchwork"));
}

TEST(SweepAxis, WhatIsNoSettingOrNoValueNamesTheOption) {
  EXPECT_THAT(refusal_of_value("seed_cuont", "3"),
              AllOf(HasSubstr("--param seed_cuont=3"), HasSubstr("is no setting")));
  EXPECT_THAT(refusal_of_value("seed_count", "many"), HasSubstr("--param seed_count=many"));
  EXPECT_THAT(refusal_of_value("seed_count", ""), HasSubstr("--param seed_count="));
}

}  // namespace
}  // namespace flagstone::cli
