// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "library/moving_points/beam_spacing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flagstone {
namespace {

// A sphere of 20 m around a sensor with 16 beams, each with two points per column.
PointArrays sphere(double spacing) {
  constexpr double degree = std::numbers::pi / 180;
  PointArrays points;
  points.start(std::size_t{16} * 2058);
  for (int beam = 0; beam < 16; ++beam) {
    for (int column = 0; column < 2058; ++column) {
      const double elevation = (beam - 8) * spacing * degree;
      const double azimuth = column * 360.0 / 2058 * degree;
      points.push_back({static_cast<float>(20 * std::cos(elevation) * std::cos(azimuth)),
                        static_cast<float>(20 * std::cos(elevation) * std::sin(azimuth)),
                        static_cast<float>(20 * std::sin(elevation))});
    }
  }
  points.finish();
  return points;
}

TEST(BeamSpacing, IsMeasured) {
  EXPECT_NEAR(measured_beam_spacing(sphere(2)), 2, 0.051);
  EXPECT_NEAR(measured_beam_spacing(sphere(1.33)), 1.33, 0.051);
  EXPECT_NEAR(measured_beam_spacing(sphere(0.45)), 0.45, 0.051);
}

TEST(BeamSpacing, IsNotSmallerThanAColumn) { EXPECT_EQ(measured_beam_spacing(sphere(0.3)), 0.35); }

TEST(BeamSpacing, HasAValueForNoPoints) {
  PointArrays none;
  none.start(0);
  EXPECT_EQ(measured_beam_spacing(none), 0.35);
}

}  // namespace
}  // namespace flagstone
