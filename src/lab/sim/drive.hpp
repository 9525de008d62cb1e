// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/route.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/traffic.hpp"

namespace flagstone::sim {

/// Mounting pose of a sensor on its vehicle.
struct Mounting {
  double height = 0;  ///< above the ground below the vehicle, metres
  double pitch = 0;   ///< degrees, positive: looks down ahead
  double roll = 0;    ///< degrees, positive: its right side is lower; applied after the pitch
};

/// The frame of a vehicle at (x, y) with heading `yaw` (radians): origin on the ground, tilted with
/// the ground below its wheels.
Frame vehicle_pose(const Ground& ground, double x, double y, double yaw);

/// The frame of the sensor on a vehicle.
Frame sensor_pose(const Frame& vehicle, const Mounting& mounting);

/// The frame of an upright sensor at its usual height, on a vehicle at (x, y) with heading `yaw`
/// (radians).
Frame sensor_pose(const Ground& ground, const Sensor& sensor, double x, double y, double yaw);

/// Seed of the scene of run `index` of a sequence. Every run has a different scene, which does not
/// depend on the number of runs.
std::uint64_t drive_seed(std::uint64_t sequence_seed, std::uint64_t index) noexcept;

/// How often a sensor measures on its way through a scene.
struct Pace {
  double rate = 1 / stop_interval;  ///< scans per second
  double speed = own_speed;         ///< of the vehicle, m/s

  /// Number of stop intervals, of frame_spacing metres, between two scans.
  [[nodiscard]] double stops_per_frame() const noexcept { return speed / rate / frame_spacing; }

  /// Number of scans in one scene: frames_per_drive at the default pace.
  [[nodiscard]] std::size_t frames() const noexcept;

  friend bool operator==(const Pace&, const Pace&) = default;
};

/// A run: the scans of a sensor on its way through one scene. The vehicle passes the stops of the
/// scene, and between them follows between_stops(). Everything that moves in the scene is as fast,
/// compared with the vehicle, as at own_speed. The constructor computes the poses; scene() builds
/// the scene. Const functions are thread-safe.
class Drive {
 public:
  /// A run with a sensor that is mounted upright at its usual height.
  Drive(const SceneKind& kind, const Sensor& sensor, std::uint64_t seed)
      : Drive(kind, sensor, {.height = sensor.height}, seed) {}

  Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed,
        const Pace& pace = {});

  /// Pose of the sensor in the world frame at each scan.
  [[nodiscard]] const std::vector<Frame>& poses() const noexcept { return poses_; }

  /// The known steps of the ground; empty in most scenes.
  [[nodiscard]] const std::vector<GroundStep>& steps() const noexcept { return landscape_.steps; }

  /// Builds the scene for scan(). The result is the same on every call, and takes a large part of a
  /// second.
  [[nodiscard]] Scene scene() const;

  /// A scan, 0 <= frame < pace.frames(), of the scene and the moving objects in it.
  /// Several threads may call it at the same time.
  [[nodiscard]] SimulatedScan scan(const Scene& scene, const Noise& noise, int frame,
                                   bool keep_no_returns = false) const;

  /// The true z of the ground at each point of that scan: true_ground() along the z axis of the
  /// vehicle.
  [[nodiscard]] std::vector<float> ground_of(const SimulatedScan& scan, int frame) const;

 private:
  Sensor sensor_;
  std::uint64_t seed_;
  Pace pace_;
  Landscape landscape_;
  std::vector<Frame> poses_;     // of the sensor
  std::vector<Vector3> upward_;  // z axes of the vehicle
};

/// One scan of a random street from an HDL-64E on a car in the right-hand lane, with the default
/// noise: about 120,000 points. Deterministic for each seed.
SimulatedScan simulate_street(std::uint64_t seed, unsigned threads = 1);

/// The true z of the ground of that street at each point of its scan, metres, sensor frame; see
/// true_ground(). `xyzi` must be the points of that scan.
std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi);

}  // namespace flagstone::sim
