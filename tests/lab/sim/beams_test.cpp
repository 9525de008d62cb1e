// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/beams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace flagstone::sim {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

double elevation_of(Vector3 beam) {
  return std::atan2(beam.z, std::hypot(beam.x, beam.y)) * degrees;
}

double azimuth_of(Vector3 beam) { return std::atan2(beam.y, beam.x) * degrees; }

// A forward grid of 3 rows and 5 columns.
Sensor small_grid() {
  return {.name = "grid",
          .title = "",
          .elevations = {10, 0, -20},
          .firings = 5,
          .azimuth_begin = -30,
          .azimuth_end = 50,
          .max_range = 100};
}

TEST(Beams, HaveUnitLengthForEverySensor) {
  for (const Sensor& sensor : Sensor::known()) {
    const Beams beams(sensor);
    const std::size_t rows = sensor.draws_rosette() ? 1 : sensor.elevations.size();
    ASSERT_EQ(beams.size(), rows * beams.row_length()) << sensor.name;
    for (std::size_t i = 0; i < beams.size(); ++i) ASSERT_NEAR(length(beams[i]), 1, 1e-12);
  }
}

TEST(Beams, RevolutionIsEvenlySpacedWithoutDuplicates) {
  const Sensor& sensor = Sensor::named("vlp-16");
  const Beams beams(sensor);

  EXPECT_EQ(azimuth_of(beams[0]), 0);
  EXPECT_NEAR(azimuth_of(beams[1]), 360.0 / sensor.firings, 1e-9);
  EXPECT_NEAR(azimuth_of(beams[beams.row_length() - 1]), -360.0 / sensor.firings, 1e-9);
  EXPECT_NEAR(elevation_of(beams[0]), 15, 1e-9);
  EXPECT_NEAR(elevation_of(beams[beams.size() - 1]), -15, 1e-9);
}

TEST(Beams, GridReachesBothEdgesOfTheFieldOfView) {
  const Beams beams(small_grid());

  ASSERT_EQ(beams.size(), 15U);
  constexpr std::array azimuths{-30.0, -10.0, 10.0, 30.0, 50.0};
  constexpr std::array elevations{10.0, 0.0, -20.0};
  for (std::size_t row = 0; row < elevations.size(); ++row) {
    for (std::size_t column = 0; column < azimuths.size(); ++column) {
      const Vector3 beam = beams[row * azimuths.size() + column];
      EXPECT_NEAR(azimuth_of(beam), azimuths[column], 1e-9);
      EXPECT_NEAR(elevation_of(beam), elevations[row], 1e-9);
    }
  }
}

TEST(Beams, SingleFiringPointsToTheStartOfTheFieldOfView) {
  Sensor sensor = small_grid();
  sensor.firings = 1;

  const Beams beams(sensor);

  ASSERT_EQ(beams.size(), 3U);
  EXPECT_NEAR(azimuth_of(beams[0]), -30, 1e-9);
}

TEST(Beams, RosetteFillsTheFieldOfViewAndStaysInside) {
  const Sensor& sensor = Sensor::named("livox-avia");
  constexpr std::size_t cells = 12;
  std::array<std::array<int, cells>, cells> hits{};
  const double width = sensor.azimuth_end - sensor.azimuth_begin;
  const double top = sensor.elevations.front();
  const double height = top - sensor.elevations.back();

  const Beams beams(sensor);

  for (std::size_t i = 0; i < beams.size(); ++i) {
    const double across = (azimuth_of(beams[i]) - sensor.azimuth_begin) / width;
    const double down = (top - elevation_of(beams[i])) / height;
    ASSERT_GE(std::min(across, down), -1e-9);
    ASSERT_LE(std::max(across, down), 1 + 1e-9);
    const auto cell = [](double share) {
      return std::min(static_cast<std::size_t>(std::max(share, 0.0) * cells), cells - 1);
    };
    ++hits[cell(down)][cell(across)];
  }
  // The rosette is round: it fills the circle inside the square.
  for (std::size_t row = 0; row < cells; ++row) {
    for (std::size_t column = 0; column < cells; ++column) {
      const double x = (static_cast<double>(column) + 0.5) / cells - 0.5;
      const double y = (static_cast<double>(row) + 0.5) / cells - 0.5;
      if (std::hypot(x, y) > 0.45) continue;
      EXPECT_GT(hits[row][column], 0) << row << ' ' << column;
    }
  }
}

TEST(Beams, RosetteContinuesWhereThePreviousScanEnded) {
  const Sensor& sensor = Sensor::named("livox-avia");
  const Beams first(sensor, 0);
  const Beams second(sensor, 1);

  const double step = length(first[1] - first[0]);
  EXPECT_NEAR(length(second[0] - first[first.size() - 1]), step, step / 2);
  EXPECT_GT(length(second[0] - first[0]), 10 * step);
}

TEST(Beams, RingsAreTheSameInEveryScan) {
  const Sensor& sensor = Sensor::named("hdl-32e");
  const Beams first(sensor, 0);
  const Beams third(sensor, 2);

  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(length(first[i] - third[i]), 0);
}

}  // namespace
}  // namespace flagstone::sim
