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

/// Time between stops of the sensor, seconds: its vehicle drives at 8 m/s.
inline constexpr double stop_interval = 1;
inline constexpr double own_speed = frame_spacing / stop_interval;  ///< m/s

enum class RoadUser : std::uint8_t { car, truck, bus, cyclist, person, forklift };

/// A road user that moves or waits while the sensor drives past.
struct Mover {
  RoadUser kind = RoadUser::car;
  std::function<Stop(double seconds)> at;  ///< pose; time since the first stop of the sensor
  std::uint64_t look = 0;                  ///< seed for model, paint and clothes
};

/// A line on the ground: its position and direction at x.
using Path = std::function<Stop(double x)>;

/// Motion along a path, `t` metres to its left, from x_begin with `speed` m/s (negative: towards
/// smaller x).
std::function<Stop(double seconds)> along(Path path, double t, double x_begin, double speed);

/// Straight motion from `begin` at `speed` m/s, which stops after `way` metres.
std::function<Stop(double seconds)> straight(Stop begin, double speed, double way);

/// All moving objects of a run. None comes near the sensor or collides with another.
class Traffic {
 public:
  explicit Traffic(std::vector<Stop> route) : route_(std::move(route)) {}

  /// Adds `mover` if, from the first stop to the last, it stays 3 m from the sensor (2.5 m for
  /// trucks and buses) and clear of all others; otherwise returns false. The sensor is assumed to
  /// drive straight from stop to stop.
  bool join(Mover mover);

  /// A row of vehicles along a lane at one speed, with `gap` metres between them. fill() adds as
  /// many as needed to fill the lane from x.low to x.high at every stop; `draw` chooses their
  /// kinds. Vehicles that join() does not accept are omitted.
  struct Lane {
    Path path;
    double t = 0;      ///< metres to the left of the path
    double speed = 0;  ///< m/s; negative: towards smaller x
    Interval x;
    Interval gap;
  };
  void fill(const Lane& lane, const std::function<RoadUser(Random&)>& draw, Random& random);

  /// All movers on the grid of the ground, with their motion; time since the first stop.
  [[nodiscard]] Mesh at(const Ground& ground, double seconds) const;

 private:
  [[nodiscard]] static Motion motion(const Mover& mover, double seconds);

  std::vector<Stop> route_;
  std::vector<Mover> movers_;
};

/// The traffic as Landscape::moving.
inline std::function<Mesh(const Ground&, double seconds)> moving(Traffic traffic) {
  return [traffic = std::move(traffic)](const Ground& on, double seconds) {
    return traffic.at(on, seconds);
  };
}

}  // namespace flagstone::sim
