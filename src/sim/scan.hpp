// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/frame.hpp"
#include "sim/noise.hpp"
#include "sim/scene.hpp"
#include "sim/sensor.hpp"

namespace flagstone::sim {

/// One turn of the sensor. Points are ordered as in KITTI's files: beam by beam, the highest first,
/// each from straight ahead counter-clockwise.
struct SimulatedScan {
  std::vector<float>
      xyzi;  ///< 4 floats a point: x, y, z in metres, sensor frame, and intensity 0..1
  std::vector<std::uint32_t> classes;  ///< SemanticKITTI id of each point, see SemanticClass

  [[nodiscard]] std::size_t size() const noexcept { return classes.size(); }
};

/// Where a sensor is when its vehicle stands at (x, y) heading for `yaw` (radians): `mount_height`
/// above the ground and tilted with it.
Frame sensor_pose(const Ground& ground, const Sensor& sensor, double x, double y, double yaw);

/// Casts every beam of one turn. The same arguments give the same bytes, for any number of
/// `threads` (0 counts as 1).
SimulatedScan simulate(const Scene& scene, const Sensor& sensor, const Noise& noise,
                       const Frame& pose, std::uint64_t seed, unsigned threads = 1);

}  // namespace flagstone::sim
