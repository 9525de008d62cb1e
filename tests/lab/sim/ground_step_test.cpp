// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/ground_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "flagstone/surface.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/scene.hpp"

namespace flagstone::sim {
namespace {

// A step that starts at y = 3 and rises to the left.
constexpr StepPlace place{.x = 5, .y = 3, .across_x = 0, .across_y = 1, .width = 0.02};

// A ramp of this rise and width in the middle of the step.
HeightAt ramp(double rise, double width) {
  return [=](double, double y) {
    const double middle = place.y + place.width / 2;
    return rise * std::clamp((y - middle) / width + 0.5, 0.0, 1.0) - 1.7;
  };
}

TEST(StepView, RampHasItsRiseAndFourFifthsOfItsWidth) {
  for (const double rise : {0.1, -1.0}) {
    for (const double width : {0.05, 0.5, 1.0}) {
      const StepView view = view_step(place, ramp(rise, width));

      EXPECT_NEAR(view.rise, rise, 1e-9);
      EXPECT_NEAR(view.width.value(), 0.8 * width, 1e-9) << rise << ", " << width;
    }
  }
}

TEST(StepView, LongRampCountsOnlyThePartNextToTheStep) {
  const StepView view = view_step(place, ramp(0.2, 2.04));

  EXPECT_NEAR(view.rise, 0.1, 1e-9);
  EXPECT_NEAR(view.width.value(), 0.8 * 1.02, 1e-9);
}

TEST(StepView, LevelGroundHasNoWidth) {
  const StepView view = view_step(place, [](double, double) { return -1.7; });

  EXPECT_EQ(view.rise, 0);
  EXPECT_FALSE(view.width);
}

TEST(StepView, IsUnknownIfOneSideIsUnknown) {
  const auto half = [](double, double y) {
    return y > place.y + 0.3 ? std::numeric_limits<double>::quiet_NaN() : -1.7;
  };

  const StepView view = view_step(place, half);

  EXPECT_TRUE(std::isnan(view.rise));
  EXPECT_FALSE(view.width);
}

TEST(StepView, HasNoWidthAcrossAGap) {
  const auto gap = [](double, double y) {
    const bool known = std::abs(y - place.y - place.width / 2) > 0.1;
    return known ? (y > place.y ? 0.1 : 0.0) : std::numeric_limits<double>::quiet_NaN();
  };

  const StepView view = view_step(place, gap);

  EXPECT_NEAR(view.rise, 0.1, 1e-9);
  EXPECT_FALSE(view.width);
}

// Cells of 0.25 m: a kerb between two rows of cell centres is spread over the distance between the
// rows.
TEST(StepView, KerbIsSpreadOverTheCellsOfAQuarterMetreGrid) {
  flagstone::GroundSurface surface;
  std::vector<flagstone::GroundSurface::Grid>& grids = surface.start();
  grids.resize(1);
  flagstone::GroundSurface::Grid& grid = grids[0];
  grid.cell = 0.25F;
  grid.width = 80;
  for (std::size_t row = 0; row < grid.width; ++row) {
    const double y = (static_cast<double>(row) + 0.5 - 40) * 0.25;
    grid.heights.insert(grid.heights.end(), grid.width, y > place.y ? -1.6F : -1.7F);
  }
  grid.confidences.assign(grid.heights.size(), 1);

  const StepView view = view_step(place, [&](double x, double y) {
    return static_cast<double>(surface.height(static_cast<float>(x), static_cast<float>(y)));
  });

  EXPECT_NEAR(view.rise, 0.1, 1e-6);
  EXPECT_NEAR(view.width.value(), 0.2, 1e-3);
}

TEST(SeenSides, HaveAGroundPointNearTheStep) {
  const auto sides = [](const std::vector<float>& points) {
    const SeenSides seen = seen_sides(place, points);
    return std::pair(seen.before, seen.behind);
  };

  EXPECT_EQ(sides({}), std::pair(false, false));
  EXPECT_EQ(sides({5.2F, 2.8F}), std::pair(true, false));
  EXPECT_EQ(sides({4.7F, 3.3F}), std::pair(false, true));
  EXPECT_EQ(sides({4.7F, 3.3F, 5.2F, 2.8F}), std::pair(true, true));
  EXPECT_EQ(sides({5, 2.4F, 5, 3.6F}), std::pair(false, false)) << "too far across";
  EXPECT_EQ(sides({5.6F, 2.8F, 4.4F, 3.3F}), std::pair(false, false)) << "too far along";
  EXPECT_EQ(sides({5, 3.01F}), std::pair(false, false)) << "on the face";
}

TEST(StepPositions, ShowTheStepInTheTrueHeightsOfEverySensor) {
  const Drive drive(*find_scene_kind("steps"), Sensor::named("hdl-64e"), 4);
  const Scene scene = drive.scene();
  for (const std::size_t frame : {2U, 7U}) {
    const Frame& pose = drive.poses()[frame];
    const HeightAt truth = true_heights(scene.ground(), pose);
    std::size_t places = 0;
    for (const GroundStep& step : drive.steps()) {
      for (const StepPlace& at : places_on(step, scene.ground(), pose)) {
        const StepView view = view_step(at, truth);
        ++places;
        // The tilt of the sensor and the slope of the ground have little influence.
        ASSERT_NEAR(view.rise, step.rise, 0.05) << step.kind;
        ASSERT_NEAR(view.width.value(), 0.8 * std::abs(step.y_end - step.y_begin), 0.3)
            << step.kind;
      }
    }
    EXPECT_GT(places, 300U);
  }
}

TEST(StepPositions, KerbIsAsSharpAsDefined) {
  const Drive drive(*find_scene_kind("steps"), Sensor::named("hdl-64e"), 4);
  const Scene scene = drive.scene();
  const Frame& pose = drive.poses()[3];
  for (const GroundStep& step : drive.steps()) {
    if (!step.kind.starts_with("kerb")) continue;
    for (const StepPlace& at : places_on(step, scene.ground(), pose)) {
      EXPECT_LT(view_step(at, true_heights(scene.ground(), pose)).width.value(), 0.25);
    }
  }
}

}  // namespace
}  // namespace flagstone::sim
