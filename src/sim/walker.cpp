// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "sim/walker.hpp"

#include <numbers>

#include "sim/person.hpp"

namespace flagstone::sim {

std::vector<Walker> draw_walkers(int count, const Strip& strip, Random& random) {
  std::vector<Walker> walkers;
  for (int i = 0; i < count; ++i) {
    const double t = random.uniform(strip.from_path.low, strip.from_path.high);
    const double speed = random.uniform(0.8, 1.8);
    walkers.push_back({.x = random.uniform(strip.x.low, strip.x.high),
                       .t = random.chance(0.5) ? t : -t,
                       .speed = random.chance(0.5) ? speed : -speed,
                       .look = random.bits()});
  }
  return walkers;
}

void add_walkers(Mesh& mesh, const Ground& ground, const WindingPath& path,
                 std::span<const Walker> walkers, int stop) {
  for (const Walker& walker : walkers) {
    const double x = walker.x + stop * seconds_between_stops * walker.speed;
    const double y = path.y(x) + walker.t;
    const double back = walker.speed < 0 ? std::numbers::pi : 0;
    Random look(walker.look);
    add_person(mesh, upright_frame({x, y, ground.height(x, y)}, path.at(x).yaw + back), look);
  }
}

}  // namespace flagstone::sim
