// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "lab/sim/extent.hpp"
#include "lab/sim/geometry.hpp"
#include "lab/sim/ground.hpp"
#include "lab/sim/mesh.hpp"
#include "lab/sim/route.hpp"

namespace flagstone::sim {

/// Time between stops of the sensor, seconds: its vehicle drives at 8 m/s.
inline constexpr double stop_interval = 1;
inline constexpr double own_speed = frame_spacing / stop_interval;  ///< m/s

/// The time at which a run enters the stretch of x, seconds.
inline double arrival_at(const Extent& extent, double x) noexcept {
  return static_cast<double>(extent.stretch_at(x)) * stops_per_stretch * stop_interval;
}

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

/// Straight motion from `begin` at `speed` m/s, which stops after `way` metres. It passes `begin`
/// at the time `start`, and sets out `lead` seconds earlier.
std::function<Stop(double seconds)> straight(Stop begin, double speed, double way, double start = 0,
                                             double lead = 1);

/// All moving objects of a run. None comes near the sensor or collides with another.
class Traffic {
 public:
  /// Movers more than `view` metres ahead of the sensor or behind it are not simulated.
  explicit Traffic(std::vector<Stop> route, double view = std::numeric_limits<double>::infinity());

  /// Adds `mover` if it is in view of the sensor at any time and, while it is, stays 3 m from the
  /// sensor (2.5 m for trucks and buses) and clear of all others; otherwise returns false. The
  /// sensor is assumed to drive straight from stop to stop.
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

  /// All movers in view and on the grid of the ground, with their motion; time since the first
  /// stop.
  [[nodiscard]] Mesh at(const Ground& ground, double seconds) const;

 private:
  // When and where a mover is in view: numbers of checks, and the part of the x axis, metres.
  struct Visit {
    int first = 0, last = -1;
    Interval x;
  };
  [[nodiscard]] Visit visit_of(const Mover& mover) const;
  [[nodiscard]] bool is_in_view(const Stop& stop, double seconds) const noexcept;
  [[nodiscard]] bool meets_sensor(const Mover& mover, const Visit& visit) const;
  [[nodiscard]] bool meets_others(const Mover& mover, const Visit& visit) const;
  [[nodiscard]] Motion motion(const Mover& mover, double seconds) const;

  std::vector<Stop> route_;
  double view_;
  int checks_;  // number of times at which positions are compared
  std::vector<Mover> movers_;
  std::vector<Visit> visits_;  // of each mover
};

/// The traffic as Landscape::moving.
inline std::function<Mesh(const Ground&, double seconds)> moving(Traffic traffic) {
  return [traffic = std::move(traffic)](const Ground& on, double seconds) {
    return traffic.at(on, seconds);
  };
}

}  // namespace flagstone::sim
