// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/true_ground.hpp"

#include <cstddef>
#include <limits>
#include <optional>

namespace flagstone::sim {

std::vector<float> true_ground(const Ground& ground, const Frame& pose, Vector3 up,
                               std::span<const float> xyzi) {
  constexpr std::size_t columns = 4;
  std::vector<float> heights;
  heights.reserve(xyzi.size() / columns);
  for (std::size_t i = 0; i + columns <= xyzi.size(); i += columns) {
    const Vector3 point{xyzi[i], xyzi[i + 1], xyzi[i + 2]};
    if (point.x == 0 && point.y == 0 && point.z == 0) {
      heights.push_back(std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    const Vector3 world = pose.to_world(point);
    const double to_ground = world.z > ground.height(world.x, world.y) ? -1 : 1;
    const std::optional<double> way = ground.first_crossing(world, to_ground * up);
    heights.push_back(way ? static_cast<float>(point.z + to_ground * *way)
                          : std::numeric_limits<float>::quiet_NaN());
  }
  return heights;
}

std::vector<float> true_ground(const Ground& ground, const Frame& pose,
                               std::span<const float> xyzi) {
  return true_ground(ground, pose, pose.up, xyzi);
}

}  // namespace flagstone::sim
