// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/scene.hpp"

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

/// Seed of the world of drive `index` of a sequence: every drive has a world of its own, which does
/// not depend on how many there are.
std::uint64_t drive_seed(std::uint64_t sequence_seed, std::uint64_t index) noexcept;

/// frames_per_drive stops of a sensor in one world. Poses are known at once; the world is built by
/// scene().
class Drive {
 public:
  /// A sensor that is mounted upright at its usual height.
  Drive(const SceneKind& kind, const Sensor& sensor, std::uint64_t seed)
      : Drive(kind, sensor, {.height = sensor.height}, seed) {}

  Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed);

  /// The sensor in the world at each stop.
  [[nodiscard]] const std::vector<Frame>& poses() const noexcept { return poses_; }

  /// Steps of the ground that the scene lists; none in most.
  [[nodiscard]] const std::vector<GroundStep>& steps() const noexcept { return landscape_.steps; }

  /// The world, ready for scan(): the same on every call, a good part of a second of work.
  [[nodiscard]] Scene scene() const;

  /// What the sensor sees at a stop, 0 <= frame < frames_per_drive, of the scene and of what moves
  /// in it. Several threads may ask.
  [[nodiscard]] SimulatedScan scan(const Scene& scene, const Noise& noise, int frame,
                                   bool keep_no_returns = false) const;

  /// Where the ground is at each point of that scan: true_ground() along the vehicle's z axis.
  [[nodiscard]] std::vector<float> ground_of(const SimulatedScan& scan, int frame) const;

 private:
  Sensor sensor_;
  std::uint64_t seed_;
  Landscape landscape_;
  std::vector<Frame> poses_;     // of the sensor
  std::vector<Vector3> upward_;  // z axes of the vehicle
};

/// One scan of a random street as an HDL-64E on a car in the right-hand lane takes it, with the
/// default noise: some 120,000 points. The same seed gives the same bytes.
SimulatedScan simulate_street(std::uint64_t seed, unsigned threads = 1);

/// Where the ground of that street truly is at each point of its scan, see true_ground(): metres,
/// sensor frame. `xyzi` are the scan's.
std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi);

}  // namespace flagstone::sim
