// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/sensor.hpp"

namespace flagstone::sim {

Sensor hdl_64e() {
  Sensor sensor{.name = "hdl-64e",
                .elevations = {},
                .azimuth_count = 2083,
                .min_range = 0.9,
                .max_range = 80,
                .range_sigma = 0.02,
                .mount_height = 1.73};
  constexpr int lasers_a_block = 32;
  constexpr double upper_top = 2;
  constexpr double lower_top = -8 - 5.0 / 6;
  for (int i = 0; i < lasers_a_block; ++i) sensor.elevations.push_back(upper_top - i / 3.0);
  for (int i = 0; i < lasers_a_block; ++i) sensor.elevations.push_back(lower_top - i / 2.0);
  return sensor;
}

}  // namespace flagstone::sim
