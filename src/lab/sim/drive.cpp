// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/drive.hpp"

#include <cstddef>
#include <optional>
#include <utility>

#include "lab/sim/true_ground.hpp"

namespace flagstone::sim {

std::uint64_t drive_seed(std::uint64_t sequence_seed, std::uint64_t index) noexcept {
  return Random::stream(sequence_seed, index).bits();
}

Drive::Drive(const SceneKind& kind, Sensor sensor, const Mounting& mounting, std::uint64_t seed)
    : sensor_(std::move(sensor)), seed_(seed), landscape_(kind.make(seed)) {
  for (const Stop& stop : landscape_.route) {
    const Frame vehicle = vehicle_pose(landscape_.ground, stop.x, stop.y, stop.yaw);
    poses_.push_back(sensor_pose(vehicle, mounting));
    upward_.push_back(vehicle.up);
  }
}

Scene Drive::scene() const { return {landscape_.ground, landscape_.furnish(landscape_.ground)}; }

SimulatedScan Drive::scan(const Scene& scene, const Noise& noise, int frame,
                          bool keep_no_returns) const {
  const auto index = static_cast<std::size_t>(frame);
  // Stream 0 of the seed has drawn the world.
  const std::uint64_t noise_seed = Random::stream(seed_, index + 1).bits();
  std::optional<RayCaster> moving;
  if (landscape_.moving) moving.emplace(landscape_.moving(landscape_.ground, frame));
  return simulate(
      scene, sensor_, noise, poses_[index], noise_seed,
      {.number = frame, .moving = moving ? &*moving : nullptr, .keep_no_returns = keep_no_returns});
}

std::vector<float> Drive::ground_of(const SimulatedScan& scan, int frame) const {
  const auto index = static_cast<std::size_t>(frame);
  return true_ground(landscape_.ground, poses_[index], upward_[index], scan.xyzi);
}

}  // namespace flagstone::sim
