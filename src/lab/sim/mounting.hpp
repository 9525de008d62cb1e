// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include "flagstone/sensor.hpp"
#include "lab/sim/frame.hpp"
#include "lab/sim/ground.hpp"

namespace flagstone::sim {

/// How a sensor sits on its vehicle.
struct Mounting {
  double height = 0;  ///< above the ground the vehicle stands on, metres
  double pitch = 0;   ///< degrees, positive: looks down ahead
  double roll = 0;    ///< degrees, positive: its right side is the lower one; after the pitch
};

/// Where a vehicle stands at (x, y) heading for `yaw` (radians), as a car on its wheels: origin on
/// the ground, tilted with it.
Frame vehicle_pose(const Ground& ground, double x, double y, double yaw);

/// Where its sensor is.
Frame sensor_pose(const Frame& vehicle, const Mounting& mounting);

/// Where an upright sensor at its usual height is when its vehicle stands at (x, y) heading for
/// `yaw` (radians).
Frame sensor_pose(const Ground& ground, const Sensor& sensor, double x, double y, double yaw);

}  // namespace flagstone::sim
