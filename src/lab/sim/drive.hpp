// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/alignment.hpp"
#include "lab/sim/extent.hpp"
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

  /// Motion distortion: the sensor fires all the time from one scan to the next, and every point is
  /// relative to its pose when it fires. Otherwise, a scan is measured at one time.
  bool distortion = false;

  /// Number of stop intervals, of frame_spacing metres, between two scans.
  [[nodiscard]] double stops_per_frame() const noexcept { return speed / rate / frame_spacing; }

  /// Number of scans in one scene: frames_per_drive at the default pace, on one stretch.
  [[nodiscard]] std::size_t frames(const Extent& extent = {}) const noexcept;

  friend bool operator==(const Pace&, const Pace&) = default;
};

/// A run: the scans of a sensor on its way through one scene. The vehicle passes the stops of the
/// scene, and between them follows between_stops(). Everything that moves in the scene is as fast,
/// compared with the vehicle, as at own_speed. The constructor computes the poses; part() builds
/// the scene. Const functions are thread-safe.
class Drive {
 public:
  /// A run with a sensor that is mounted upright at its usual height.
  Drive(const SceneKind& kind, const Sensor& sensor, std::uint64_t seed)
      : Drive(kind, sensor, {.height = sensor.height}, seed) {}

  /// A long `extent` needs a kind of scene that can be long, and follows an Alignment.
  Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed,
        const Pace& pace = {}, const Extent& extent = {});

  /// Pose of the sensor in the world frame at each scan; with motion distortion, at its first
  /// firing.
  [[nodiscard]] const std::vector<Frame>& poses() const noexcept { return poses_; }

  /// The known steps of the ground; empty in most scenes.
  [[nodiscard]] const std::vector<GroundStep>& steps() const noexcept { return landscape_.steps; }

  /// Pose of the sensor at a time between scans, in scans, at least 0. Behind the last stop, the
  /// vehicle stands still.
  [[nodiscard]] Frame pose_at(double scans) const { return at(scans).sensor; }

  [[nodiscard]] const Ground& ground() const noexcept { return *ground_; }

  /// @name The scene, stretch by stretch
  /// A scan needs only the stretches near the sensor. They are numbered as the run passes them:
  /// from first_part(), and on a circuit every stretch has a number per lap.
  /// @{
  /// The parts that a scan needs: `count` from `first` on.
  struct Parts {
    std::size_t first = 0, count = 1;
  };
  [[nodiscard]] static Parts parts_of(std::size_t frame, const Pace& pace,
                                      const Extent& extent) noexcept;
  [[nodiscard]] static std::size_t part_count(const Extent& extent) noexcept;

  /// Builds a part. The result is the same on every call, and takes a large part of a second.
  [[nodiscard]] std::shared_ptr<const RayCaster> part(std::size_t number) const;

  [[nodiscard]] Scene scene(std::vector<std::shared_ptr<const RayCaster>> parts) const {
    return {ground_, std::move(parts)};
  }
  /// @}

  /// Builds the scene for a scan, by default for the first one.
  [[nodiscard]] Scene scene(std::size_t frame = 0) const;

  /// A scan, 0 <= frame < pace.frames(extent), of the scene and the moving objects in it.
  /// Several threads may call it at the same time.
  [[nodiscard]] SimulatedScan scan(const Scene& scene, const Noise& noise, int frame,
                                   bool keep_no_returns = false) const;

  /// The true z of the ground at each point of that scan: true_ground() along the z axis of the
  /// vehicle.
  [[nodiscard]] std::vector<float> ground_of(const SimulatedScan& scan, int frame) const;

  /// The time of each point of a scan after its first firing, seconds; 0 without motion distortion.
  [[nodiscard]] std::vector<float> times_of(const SimulatedScan& scan) const;

 private:
  struct Pose {
    Frame sensor;
    Vector3 up;  // z axis of the vehicle
  };
  [[nodiscard]] Pose at(double scans) const;
  [[nodiscard]] double time_of(std::uint32_t firing) const noexcept;
  [[nodiscard]] RayCaster moving_at(double scans) const;
  [[nodiscard]] Mesh in_world(Mesh mesh) const;

  Sensor sensor_;
  Mounting mounting_;
  std::uint64_t seed_;
  Pace pace_;
  Extent extent_;
  Landscape landscape_;
  std::optional<Alignment> alignment_;    // of a long scene
  std::shared_ptr<const Ground> ground_;  // in the world frame
  std::vector<Frame> poses_;              // of the sensor
  std::vector<Vector3> upward_;           // z axes of the vehicle
};

/// One scan of a random street from an HDL-64E on a car in the right-hand lane, with the default
/// noise: about 120,000 points. Deterministic for each seed.
SimulatedScan simulate_street(std::uint64_t seed, unsigned threads = 1);

/// The true z of the ground of that street at each point of its scan, metres, sensor frame; see
/// true_ground(). `xyzi` must be the points of that scan.
std::vector<float> street_ground(std::uint64_t seed, std::span<const float> xyzi);

}  // namespace flagstone::sim
