// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// How long the sensor takes from one stop to the next, seconds: its vehicle drives 8 m/s.
inline constexpr double stop_interval = 1;
inline constexpr double own_speed = frame_spacing / stop_interval;  ///< metres a second

enum class RoadUser : std::uint8_t { car, truck, bus, cyclist, person, forklift };

/// Someone who moves, or waits, while the sensor drives by.
struct Mover {
  RoadUser kind = RoadUser::car;
  std::function<Stop(double seconds)> at;  ///< where, since the sensor's first stop
  std::uint64_t look = 0;                  ///< draws kind, paint and clothes
};

/// A line on the ground by x: where it is there, and its direction.
using Path = std::function<Stop(double x)>;

/// The way of who follows a path `t` metres to its left: from x_begin on with `speed` metres a
/// second, below 0 towards smaller x.
std::function<Stop(double seconds)> along(Path path, double t, double x_begin, double speed);

/// The way of who goes straight on from a place, at `speed` metres a second, and stands still after
/// `way` metres.
std::function<Stop(double seconds)> straight(Stop begin, double speed, double way);

/// All that moves in a drive. Nobody comes near the sensor or runs into another.
class Traffic {
 public:
  explicit Traffic(std::vector<Stop> route) : route_(std::move(route)) {}

  /// Takes part if, from the first stop to the last, it stays 3 m from the sensor (2.5 m if it is a
  /// truck or bus) and clear of all others; false if it does not. The sensor is taken to drive
  /// straight from stop to stop.
  bool join(Mover mover);

  /// A row of cars, or of what `draw` says, along a lane at one speed, `gap` metres from one's
  /// end to the next one's front, so many that from x.low to x.high the lane is filled at every
  /// stop. Those that cannot join are left out.
  struct Lane {
    Path path;
    double t = 0;      ///< metres to the left of the path
    double speed = 0;  ///< metres a second, below 0 towards smaller x
    Interval x;
    Interval gap;
  };
  void fill(const Lane& lane, const std::function<RoadUser(Random&)>& draw, Random& random);

  /// Everyone who is on the ground's grid, as they are at a stop.
  [[nodiscard]] Mesh at(const Ground& ground, int stop) const;

 private:
  std::vector<Stop> route_;
  std::vector<Mover> movers_;
};

/// The traffic as what moves in a Landscape.
inline std::function<Mesh(const Ground&, int stop)> moving(Traffic traffic) {
  return
      [traffic = std::move(traffic)](const Ground& on, int stop) { return traffic.at(on, stop); };
}

}  // namespace flagstone::sim
