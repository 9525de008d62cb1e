// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "files/render/birds_eye.hpp"
#include "files/render/canvas.hpp"
#include "files/render/picture.hpp"
#include "files/render/zone_layer.hpp"

namespace flagstone::render {
namespace {

constexpr Color teal{9, 77, 62};  // colour of ground patches on the panel

class BirdsEyeZones : public PictureTest {
 protected:
  BirdsEyeZones() {
    config_.min_range = 4;
    config_.zones = {{.ring_radii = {10, 20}, .sectors = 8}, {.ring_radii = {40}, .sectors = 16}};
    options_.zones = &config_;
    options_.width = 1600;
    options_.height = 1780;
  }

  // The colour at a distance in metres and a direction in degrees counter-clockwise from x.
  Color at(const Picture& picture, double distance, double degrees) const {
    const TopView view(panel(), options_.range);
    const double angle = degrees * std::numbers::pi / 180;
    return picture.at(view.column(distance * std::sin(angle)),
                      view.row(distance * std::cos(angle)));
  }

  PatchworkConfig config_;
};

TEST_F(BirdsEyeZones, HasALineAtEachRing) {
  const Picture picture = draw({});

  for (const double radius : {4.0, 10.0, 20.0})
    EXPECT_GT(at(picture, radius, 70).red, 60) << radius;
  for (const double radius : {3.0, 7.0, 15.0, 30.0})
    EXPECT_EQ(at(picture, radius, 70), panel_color);
}

TEST_F(BirdsEyeZones, HasALineAtEachSectorOfAZone) {
  const Picture picture = draw({});

  for (int line = 0; line < 8; ++line) EXPECT_GT(at(picture, 15, 45 * line).red, 30) << line;
  for (int line = 0; line < 16; ++line) EXPECT_GT(at(picture, 30, 22.5 * line).red, 30) << line;
  EXPECT_EQ(at(picture, 15, 22.5), panel_color);
}

TEST_F(BirdsEyeZones, FillsABinByItsStatus) {
  options_.tint_patches = true;
  LabelledScan scan;
  scan.result.mutable_patches() = {
      {.zone = 0, .ring = 1, .sector = 0, .verdict = Verdict::ground},
      {.zone = 1, .ring = 0, .sector = 12, .verdict = Verdict::ground},
  };

  const Picture picture = draw(scan);

  EXPECT_EQ(at(picture, 15, -157.5), teal);
  EXPECT_EQ(at(picture, 7, -157.5), panel_color);
  EXPECT_EQ(at(picture, 15, -112.5), panel_color);
  EXPECT_EQ(at(picture, 15, 157.5), panel_color);
  EXPECT_EQ(at(picture, 30, 101.25), teal);
  EXPECT_EQ(at(picture, 30, 78.75), panel_color);
}

TEST_F(BirdsEyeZones, HasLinesAndBinsOnlyWithinANarrowFieldOfView) {
  config_.field_of_view = {.begin = -60, .width = 120};
  options_.tint_patches = true;
  LabelledScan scan;
  scan.result.mutable_patches() = {
      {.zone = 1, .ring = 0, .sector = 15, .verdict = Verdict::ground}};  // 52.5 to 60 degrees

  const Picture picture = draw(scan);

  EXPECT_EQ(at(picture, 30, 56), teal);
  EXPECT_EQ(at(picture, 30, 50), panel_color);
  for (const double inside : {-55.0, 5.0, 20.0}) {
    EXPECT_GT(at(picture, 20, inside).red, 60) << inside;
  }
  EXPECT_GT(at(picture, 30, -60).red, 30);  // edges of the field of view
  EXPECT_GT(at(picture, 30, 60).red, 30);
  for (const double outside : {65.0, 180.0, -65.0}) {
    for (const double radius : {4.0, 10.0, 15.0, 20.0, 30.0}) {
      EXPECT_EQ(at(picture, radius, outside), panel_color) << radius << " at " << outside;
    }
  }
}

TEST_F(BirdsEyeZones, FillsBinsOnlyOnRequest) {
  LabelledScan scan;
  scan.result.mutable_patches() = {{.zone = 0, .ring = 1, .sector = 0, .verdict = Verdict::ground}};

  EXPECT_EQ(at(draw(scan), 15, -157.5), panel_color);
}

TEST_F(BirdsEyeZones, UsesADifferentColourForEachStatusOfABin) {
  options_.tint_patches = true;
  std::vector<Color> colors = {panel_color};
  for (const Verdict verdict : {Verdict::ground, Verdict::ground_flat, Verdict::too_few_points,
                                Verdict::no_plane, Verdict::not_upright, Verdict::too_high}) {
    LabelledScan scan;
    scan.result.mutable_patches() = {{.zone = 0, .ring = 1, .sector = 0, .verdict = verdict}};
    colors.push_back(at(draw(scan), 15, -157.5));
  }

  for (std::size_t i = 0; i < colors.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(colors[i] == colors[j]) << i << " and " << j;
}

TEST_F(BirdsEyeZones, SupportsEveryStatusExceptThoseOfSurface) {
  for (std::uint16_t code = 0; std::string_view("unknown") != to_string(Verdict{code}); ++code) {
    const Verdict verdict{code};
    const bool is_of_surface = verdict == Verdict::mixed || verdict == Verdict::off_surface;

    EXPECT_EQ(std::ranges::count(verdict_looks(), verdict, &VerdictLook::verdict),
              is_of_surface ? 0 : 1)
        << to_string(verdict);
  }
}

}  // namespace
}  // namespace flagstone::render
