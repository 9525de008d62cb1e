// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/simulate_street.hpp"

#include "sim/noise.hpp"
#include "sim/sensor.hpp"
#include "sim/street.hpp"

namespace flagstone::sim {

SimulatedScan simulate_street(std::uint64_t seed, unsigned threads) {
  constexpr double right_lane = -1.6;  // metres left of the centre line
  const Scene street = make_street(seed);
  const Sensor sensor = hdl_64e();
  const Frame pose = sensor_pose(street.ground(), sensor, 0, right_lane, 0);
  return simulate(street, sensor, Noise{}, pose, seed, threads);
}

}  // namespace flagstone::sim
