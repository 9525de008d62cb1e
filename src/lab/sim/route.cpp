// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/route.hpp"

#include <cmath>
#include <numbers>

namespace flagstone::sim {

std::vector<Stop> wander_along(const std::function<Stop(double x)>& path, Random& random) {
  constexpr double along = 0.5;
  constexpr double across = 0.25;
  constexpr double turn = 2 * std::numbers::pi / 180;
  std::vector<Stop> stops;
  for (int frame = 0; frame < frames_per_drive; ++frame) {
    Stop stop = path(-half_drive + frame * frame_spacing + random.uniform(-along, along));
    const double aside = random.uniform(-across, across);
    stop.x -= aside * std::sin(stop.yaw);
    stop.y += aside * std::cos(stop.yaw);
    stop.yaw += random.uniform(-turn, turn);
    stops.push_back(stop);
  }
  return stops;
}

}  // namespace flagstone::sim
