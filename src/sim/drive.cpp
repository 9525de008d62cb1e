// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/drive.hpp"

#include <cstddef>
#include <utility>

namespace flagstone::sim {

std::uint64_t drive_seed(std::uint64_t sequence_seed, std::uint64_t index) noexcept {
  return Random::stream(sequence_seed, index).bits();
}

Drive::Drive(const SceneKind& kind, Sensor sensor, std::uint64_t seed)
    : sensor_(std::move(sensor)), seed_(seed), landscape_(kind.make(seed)) {
  for (const Stop& stop : landscape_.route) {
    poses_.push_back(sensor_pose(landscape_.ground, sensor_, stop.x, stop.y, stop.yaw));
  }
}

Scene Drive::scene() const { return {landscape_.ground, landscape_.furnish(landscape_.ground)}; }

SimulatedScan Drive::scan(const Scene& scene, const Noise& noise, int frame) const {
  const auto index = static_cast<std::size_t>(frame);
  // Stream 0 of the seed has drawn the world.
  const std::uint64_t noise_seed = Random::stream(seed_, index + 1).bits();
  return simulate(scene, sensor_, noise, poses_[index], noise_seed);
}

}  // namespace flagstone::sim
