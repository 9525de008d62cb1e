// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/sensor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>

namespace flagstone::sim {
namespace {

TEST(Hdl64e, HasTwoBlocksOf32Beams) {
  const Sensor sensor = hdl_64e();

  ASSERT_EQ(sensor.elevations.size(), 64U);
  EXPECT_NEAR(sensor.elevations[0], 2, 1e-9);
  EXPECT_NEAR(sensor.elevations[31], -8.33, 0.01);
  EXPECT_NEAR(sensor.elevations[32], -8.83, 0.01);
  EXPECT_NEAR(sensor.elevations[63], -24.33, 0.01);
  for (std::size_t i = 1; i < 32; ++i) {
    EXPECT_NEAR(sensor.elevations[i - 1] - sensor.elevations[i], 1.0 / 3, 1e-9);
    EXPECT_NEAR(sensor.elevations[i + 31] - sensor.elevations[i + 32], 0.5, 1e-9);
  }
}

TEST(Hdl64e, FiresEvery0_173Degrees) {
  const Sensor sensor = hdl_64e();

  EXPECT_EQ(sensor.azimuth(0), 0);
  EXPECT_NEAR(sensor.azimuth(1), 0.1728, 0.0001);
  EXPECT_LT(sensor.azimuth(sensor.azimuth_count - 1), 360);
}

}  // namespace
}  // namespace flagstone::sim
