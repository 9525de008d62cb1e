// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/simulate_street.hpp"

#include "flagstone/sensor.hpp"
#include "lab/sim/mounting.hpp"
#include "lab/sim/noise.hpp"
#include "lab/sim/street.hpp"
#include "lab/sim/true_ground.hpp"

namespace flagstone::sim {
namespace {

/// Where the sensor is in a street.
Frame pose_in(const Scene& street, const Sensor& sensor) {
  constexpr double right_lane = -1.6;  // metres left of the centre line
  return sensor_pose(street.ground(), sensor, 0, right_lane, 0);
}

}  // namespace

SimulatedScan simulate_street(std::uint64_t seed, unsigned threads) {
  const Scene street = make_street(seed);
  const Sensor& sensor = Sensor::named("hdl-64e");
  return simulate(street, sensor, Noise{}, pose_in(street, sensor), seed, {.threads = threads});
}

std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi) {
  const Scene street = make_street(seed);
  return true_ground(street.ground(), pose_in(street, Sensor::named("hdl-64e")), xyzi);
}

}  // namespace flagstone::sim
