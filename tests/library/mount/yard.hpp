// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "flagstone/cloud_view.hpp"
#include "flagstone/mount.hpp"
#include "lab/sim/drive.hpp"
#include "lab/sim/mesh.hpp"

namespace flagstone::tests {

/// A scene around a vehicle at its origin, heading along x.
struct Yard {
  /// Height of the ground, metres; sampled every metre.
  std::function<double(double x, double y)> ground = [](double, double) { return 0.0; };
  std::vector<sim::Box> boxes{};  ///< objects in it, in the frame of the scene
  std::string sensor = "hdl-64e";
  sim::Mounting mounting{.height = 1.73};
};

/// A scan of a yard and the true mounting pose of the sensor.
struct YardScan {
  std::vector<Point> points;
  Mount mount;

  [[nodiscard]] CloudView view() const { return CloudView(std::span<const Point>(points)); }
};

/// Simulates a scan, with noise and ghost points below the ground.
YardScan scan_of(const Yard& yard);

/// Degrees between two directions.
float degrees_between(const std::array<float, 3>& a, const std::array<float, 3>& b);

/// Level ground `height` metres below the sensor, 3 m to 12 m away from it: 5,000 points.
std::vector<Point> level_ground(float height);

}  // namespace flagstone::tests
