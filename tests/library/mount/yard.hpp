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

/// A world around a vehicle that stands at its origin, heading along x.
struct Yard {
  /// Height of the ground, metres; sampled every metre.
  std::function<double(double x, double y)> ground = [](double, double) { return 0.0; };
  std::vector<sim::Box> boxes{};  ///< what stands in it, in the world's frame
  std::string sensor = "hdl-64e";
  sim::Mounting mounting{.height = 1.73};
};

/// A scan of it and the truth about the sensor.
struct YardScan {
  std::vector<Point> points;
  Mount mount;

  [[nodiscard]] CloudView view() const { return CloudView(std::span<const Point>(points)); }
};

/// What the sensor sees, with the noise that the simulator gives it, ghosts below the ground too.
YardScan scan_of(const Yard& yard);

/// Degrees between two directions.
float degrees_between(const std::array<float, 3>& a, const std::array<float, 3>& b);

/// Level ground so far below the sensor, from 3 m to 12 m around it: 5,000 points.
std::vector<Point> level_ground(float height);

}  // namespace flagstone::tests
