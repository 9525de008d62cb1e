// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
#include "sim/ground.hpp"
#include "sim/mesh.hpp"
#include "sim/open_land.hpp"

namespace flagstone::sim {

/// Time between two stops of a drive, seconds: frame_spacing at 8 m/s.
inline constexpr double seconds_between_stops = 1;

/// Nothing that moves comes nearer to the sensor's path than this, metres.
inline constexpr double clear_of_path = 3;

/// Somebody who walks beside a path, or stands with speed 0.
struct Walker {
  double x = 0, t = 0;     ///< at stop 0, metres; t left of the path
  double speed = 0;        ///< along x, metres a second
  std::uint64_t look = 0;  ///< seed of how the person looks
};

/// People on a strip on either side of a path, walking to and fro.
std::vector<Walker> draw_walkers(int count, const Strip& strip, Random& random);

/// All of them as they are at a stop.
void add_walkers(Mesh& mesh, const Ground& ground, const WindingPath& path,
                 std::span<const Walker> walkers, int stop);

}  // namespace flagstone::sim
