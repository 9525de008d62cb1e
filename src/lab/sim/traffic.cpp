// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "lab/sim/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "lab/sim/geometry.hpp"
#include "lab/sim/people.hpp"
#include "lab/sim/vehicles.hpp"

namespace flagstone::sim {
namespace {

struct Footprint {
  double length, width;  // metres
};
Footprint footprint(RoadUser kind) noexcept {
  switch (kind) {
    case RoadUser::car: return {longest_car, widest_car};
    case RoadUser::truck: return {truck_length, truck_width};
    case RoadUser::bus: return {bus_length, bus_width};
    case RoadUser::cyclist: return {1.8, 0.7};
    case RoadUser::person: return {0.7, 0.7};
    case RoadUser::forklift: return {forklift_length, forklift_width};
  }
  return {};
}

// Distance from a position to the nearest part of an object at a stop, metres.
double distance_to(const Stop& stop, Footprint size, double x, double y) noexcept {
  const double dx = x - stop.x;
  const double dy = y - stop.y;
  const double ahead = dx * std::cos(stop.yaw) + dy * std::sin(stop.yaw);
  const double aside = dy * std::cos(stop.yaw) - dx * std::sin(stop.yaw);
  return std::hypot(std::max(std::abs(ahead) - size.length / 2, 0.0),
                    std::max(std::abs(aside) - size.width / 2, 0.0));
}

// Whether the two are closer than `gap` metres. Tests points along the middle line of one.
bool meet(const Stop& one, Footprint one_size, const Stop& other, Footprint other_size,
          double gap) noexcept {
  const double reach =
      (one_size.length + other_size.length) / 2 + one_size.width + other_size.width + gap;
  if (std::abs(one.x - other.x) > reach || std::abs(one.y - other.y) > reach) return false;
  const double half = std::max(0.0, (one_size.length - one_size.width) / 2);
  const int points = 1 + 2 * static_cast<int>(std::ceil(half));
  for (int i = 0; i < points; ++i) {
    const double along = points == 1 ? 0 : half * (2.0 * i / (points - 1) - 1);
    const double from = distance_to(other, other_size, one.x + along * std::cos(one.yaw),
                                    one.y + along * std::sin(one.yaw));
    if (from < one_size.width / 2 + gap) return true;
  }
  return false;
}

constexpr double checked_every = 0.2;  // seconds

Stop on_route(const std::vector<Stop>& route, double seconds) noexcept {
  const double stops = seconds / stop_interval;
  const auto before = std::min(static_cast<std::size_t>(stops), route.size() - 2);
  const double share = stops - static_cast<double>(before);
  const Stop& one = route[before];
  const Stop& next = route[before + 1];
  return {
      .x = one.x + share * (next.x - one.x), .y = one.y + share * (next.y - one.y), .yaw = one.yaw};
}

void add_vehicle(Mesh& mesh, const Ground& ground, const Mover& mover, const Stop& stop,
                 Random& random) {
  const auto on_wheels = [&](double wheelbase, double track) {
    return frame_on_wheels(ground, stop.x, stop.y, stop.yaw, wheelbase, track);
  };
  switch (mover.kind) {
    case RoadUser::car: return add_car(mesh, on_wheels(2.6, 1.5), random);
    case RoadUser::truck: return add_truck(mesh, on_wheels(11, 2), random);
    case RoadUser::bus: return add_bus(mesh, on_wheels(6, 2), random);
    case RoadUser::forklift: return add_forklift(mesh, on_wheels(1.6, 1), random);
    case RoadUser::cyclist: return add_cyclist(mesh, on_wheels(1, 0.3), random);
    case RoadUser::person:
      return add_person(
          mesh, upright_frame({stop.x, stop.y, ground.height(stop.x, stop.y)}, stop.yaw), random);
  }
}

}  // namespace

std::function<Stop(double seconds)> along(Path path, double t, double x_begin, double speed) {
  return [path = std::move(path), t, x_begin, speed](double seconds) {
    Stop stop = path(x_begin + speed * seconds);
    stop.y += t;
    if (speed < 0) stop.yaw += std::numbers::pi;
    return stop;
  };
}

std::function<Stop(double seconds)> straight(Stop begin, double speed, double way, double start,
                                             double lead) {
  return [begin, speed, way, start, lead](double seconds) {
    const double gone = std::min(speed * std::max(seconds - start, -lead), way);
    return Stop{.x = begin.x + gone * std::cos(begin.yaw),
                .y = begin.y + gone * std::sin(begin.yaw),
                .yaw = begin.yaw};
  };
}

Traffic::Traffic(std::vector<Stop> route, double view)
    : route_(std::move(route)),
      view_(view),
      checks_(
          static_cast<int>(static_cast<double>(route_.size() - 1) * stop_interval / checked_every) +
          1) {}

bool Traffic::is_in_view(const Stop& stop, double seconds) const noexcept {
  return std::abs(stop.x - on_route(route_, seconds).x) < view_;
}

Traffic::Visit Traffic::visit_of(const Mover& mover) const {
  Visit visit;
  for (int check = 0; check < checks_; ++check) {
    const double seconds = check * checked_every;
    const Stop stop = mover.at(seconds);
    if (!is_in_view(stop, seconds)) continue;
    if (visit.last < 0) visit = {.first = check, .last = check, .x = {stop.x, stop.x}};
    visit.last = check;
    visit.x = {std::min(visit.x.low, stop.x), std::max(visit.x.high, stop.x)};
  }
  return visit;
}

bool Traffic::meets_sensor(const Mover& mover, const Visit& visit) const {
  const Footprint size = footprint(mover.kind);
  const bool wide = mover.kind == RoadUser::truck || mover.kind == RoadUser::bus;
  const double from_sensor = wide ? 2.5 : 3;
  constexpr Footprint own_size{.length = 10,
                               .width = 2};  // including the distance to the car ahead
  for (int check = visit.first; check <= visit.last; ++check) {
    const double seconds = check * checked_every;
    const Stop own = on_route(route_, seconds);
    const Stop stop = mover.at(seconds);
    if (distance_to(stop, size, own.x, own.y) < from_sensor ||
        meet(own, own_size, stop, size, 0.2)) {
      return true;
    }
  }
  return false;
}

bool Traffic::meets_others(const Mover& mover, const Visit& visit) const {
  constexpr double longest_reach = 25;  // metres, more than meet() looks
  const Footprint size = footprint(mover.kind);
  const bool walks = mover.kind == RoadUser::person;
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const Mover& other = movers_[i];
    const Visit& known = visits_[i];
    if (known.x.high < visit.x.low - longest_reach || known.x.low > visit.x.high + longest_reach) {
      continue;
    }
    const double gap = walks && other.kind == RoadUser::person ? 0.1 : 0.4;
    const int last = std::min(visit.last, known.last);
    for (int check = std::max(visit.first, known.first); check <= last; ++check) {
      const double seconds = check * checked_every;
      if (meet(mover.at(seconds), size, other.at(seconds), footprint(other.kind), gap)) return true;
    }
  }
  return false;
}

bool Traffic::join(Mover mover) {
  const Visit visit = visit_of(mover);
  if (visit.last < 0 || meets_sensor(mover, visit) || meets_others(mover, visit)) return false;
  movers_.push_back(std::move(mover));
  visits_.push_back(visit);
  return true;
}

void Traffic::fill(const Lane& lane, const std::function<RoadUser(Random&)>& draw, Random& random) {
  const double way = lane.speed * static_cast<double>(route_.size() - 1) * stop_interval;
  const double end = lane.x.high - std::min(way, 0.0);
  double x = lane.x.low - std::max(way, 0.0) + random.uniform(0, lane.gap.high);
  while (x < end) {
    const RoadUser kind = draw(random);
    const double half = footprint(kind).length / 2;
    x += half;
    join({.kind = kind, .at = along(lane.path, lane.t, x, lane.speed), .look = random.bits()});
    x += half + random.uniform(lane.gap.low, lane.gap.high);
  }
}

Motion Traffic::motion(const Mover& mover, double seconds) const {
  constexpr double slowest = 0.1;  // m/s; a slower object stands still
  constexpr double interval = 0.1;
  const auto moves_at = [&](double time) {
    const Stop before = mover.at(time - interval / 2);
    const Stop after = mover.at(time + interval / 2);
    return std::hypot(after.x - before.x, after.y - before.y) > slowest * interval;
  };
  if (moves_at(seconds)) return Motion::now;
  for (int check = 0; check < checks_; ++check) {
    if (moves_at(check * checked_every)) return Motion::later;
  }
  return Motion::none;
}

Mesh Traffic::at(const Ground& ground, double seconds) const {
  constexpr double margin = 8;  // about half the length of the longest vehicle, metres
  Mesh mesh;
  for (const Mover& mover : movers_) {
    const Stop now = mover.at(seconds);
    if (!is_in_view(now, seconds)) continue;
    if (!ground.covers(now.x - margin, now.y) || !ground.covers(now.x + margin, now.y)) continue;
    Random random(mover.look);
    const std::size_t first = mesh.triangles().size();
    add_vehicle(mesh, ground, mover, now, random);
    mesh.set_motion(first, motion(mover, seconds));
  }
  return mesh;
}

}  // namespace flagstone::sim
