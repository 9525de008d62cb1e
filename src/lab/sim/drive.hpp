// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "flagstone/sensor.hpp"
#include "lab/sim/frame.hpp"
#include "lab/sim/landscape.hpp"
#include "lab/sim/mounting.hpp"
#include "lab/sim/scan.hpp"
#include "lab/sim/scene.hpp"
#include "lab/sim/scene_kind.hpp"

namespace flagstone::sim {

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

}  // namespace flagstone::sim
