// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/examination.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "library/core/point_validity.hpp"
#include "library/core/statistics.hpp"

namespace flagstone::doctor {
namespace {

/// The valid points of a scan, in their order, and counts of the others.
struct UsablePoints {
  std::vector<Vector3f> places;  ///< in the units and axes of the file
  std::vector<int> rings;        ///< of each point, from the field `ring`; empty if there is none

  std::size_t given = 0;       ///< all points of the scan
  std::size_t zero = 0;        ///< all three coordinates are zero: missing returns
  std::size_t not_finite = 0;  ///< a coordinate is NaN or infinite
  std::size_t repeated = 0;    ///< valid points with the coordinates of an earlier one
};

std::size_t count_repeated(std::vector<Vector3f> places) {
  std::ranges::sort(places);
  const auto repeated = std::ranges::unique(places);
  return static_cast<std::size_t>(std::ranges::distance(repeated));
}

bool are_ring_numbers(const std::vector<int>& rings) {
  constexpr std::size_t most_rings = 1024;
  std::set<int> different;
  for (const int ring : rings) {
    different.insert(ring);
    if (ring < 0 || different.size() > most_rings) return false;
  }
  return different.size() >= 2;
}

/// Selects the valid points of a scan. A field `ring` is used if it contains 2 to 1,024 different
/// non-negative integers.
UsablePoints usable_points(const io::Cloud& cloud) {
  UsablePoints usable;
  const CloudView view = cloud.view();
  const io::Field* const ring = cloud.find("ring");
  bool has_rings = ring != nullptr && ring->count == 1;
  usable.given = view.size();
  for (std::size_t i = 0; i < view.size(); ++i) {
    const Point p = view[i];
    if (!is_finite(p)) {
      ++usable.not_finite;
    } else if (is_missing_return(p)) {
      ++usable.zero;
    } else {
      usable.places.push_back({p.x, p.y, p.z});
      if (!has_rings) continue;
      const double number = cloud.value(i, *ring);
      has_rings = std::abs(number) < 1e6 && number == std::floor(number);
      usable.rings.push_back(has_rings ? static_cast<int>(number) : 0);
    }
  }
  if (!has_rings || !are_ring_numbers(usable.rings)) usable.rings.clear();
  usable.repeated = count_repeated(usable.places);
  return usable;
}

/// Typical reach of a scan in metres; real values are 15 in a room to 150 on a motorway. The unit
/// is the one for which the reach is closest to this value.
constexpr double usual_reach = 50;

double metres_per_unit(double reach) {
  const std::array<double, 3> units{1, 0.01, 0.001};
  return *std::ranges::min_element(units, {}, [&](double unit) {
    return std::abs(std::log(std::max(reach, 1e-30) * unit / usual_reach));
  });
}

/// The extent of at least one point.
Extent extent_of(std::span<const Vector3f> places) {
  Extent extent;
  std::vector<float> values(places.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::ranges::transform(places, values.begin(), [&](const Vector3f& p) { return p[axis]; });
    extent.middle[axis] = percentile(values, 50);
    const double span = double{percentile(values, 95)} - double{percentile(values, 5)};
    extent.spread = std::max(extent.spread, span / 2);
  }
  std::ranges::transform(places, values.begin(), [](const Vector3f& p) {
    return static_cast<float>(std::hypot(double{p[0]}, double{p[1]}, double{p[2]}));
  });
  extent.reach = percentile(values, 99);
  extent.farthest = percentile(values, 100);
  extent.metres = metres_per_unit(extent.reach);
  return extent;
}

/// Finds the points above the ground that are closer to the sensor than `radius`, in the x-y plane.
/// `places`: relative to the sensor, z up, with the ground at z = `ground`. All in metres.
EgoVehicle find_ego_vehicle(std::span<const Vector3f> places, double ground, double radius) {
  constexpr double over_ground = 0.3;
  constexpr double step = 0.1;
  constexpr double roof_share = 0.3;  // of the points near the sensor, in one layer
  std::array<std::size_t, 60> layers{};
  std::size_t around = 0;
  for (const Vector3f& place : places) {
    if (std::hypot(double{place[0]}, double{place[1]}) >= radius) continue;
    const double height = double{place[2]} - ground;
    if (height < over_ground) continue;
    ++around;
    const auto layer = static_cast<std::size_t>(height / step);
    if (layer < layers.size()) ++layers[layer];
  }
  EgoVehicle vehicle;
  if (around == 0) return vehicle;
  vehicle.share = static_cast<double>(around) / static_cast<double>(places.size());
  const auto most = std::ranges::max_element(layers);
  if (static_cast<double>(*most) > roof_share * static_cast<double>(around)) {
    vehicle.roof = step * (static_cast<double>(most - layers.begin()) + 0.5);
  }
  return vehicle;
}

/// Points of the ego vehicle are closer to the sensor than this, metres.
constexpr double ego_radius = 2.7;

/// The points relative to `middle`, converted to metres and rotated so that `axis` becomes z.
/// `places` and `middle`: in the units of the file.
std::vector<Vector3f> turned(std::span<const Vector3f> places, const Vector3f& axis, double metres,
                             const Vector3f& middle) {
  const mount::Turn turn = mount::turn_to_z(axis);
  std::vector<Vector3f> result(places.size());
  std::ranges::transform(places, result.begin(), [&](const Vector3f& p) {
    const Vector3f q = turn.apply({p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]});
    const auto scale = static_cast<float>(metres);
    return Vector3f{scale * q[0], scale * q[1], scale * q[2]};
  });
  return result;
}

void move_origin(std::vector<Vector3f>& places, const Vector3f& to) {
  for (Vector3f& place : places) {
    for (std::size_t i = 0; i < 3; ++i) place[i] -= to[i];
  }
}

/// The ego vehicle around `sensor`: metres, in the frame rotated so that the axis is z.
EgoVehicle ego_vehicle(std::span<const Vector3f> places, const Vector3f& sensor,
                       const Examination& seen) {
  const Vector3f& axis = seen.orientation.axis;
  const Vector3f& up = seen.orientation.decision.mount.up;
  const mount::Turn turn = mount::turn_to_z(axis);
  std::vector<Vector3f> upright = turned(places, up, seen.extent.metres, {});
  move_origin(upright, mount::turn_to_z(up).apply(turn.undo(sensor)));
  const float ground = (seen.orientation.ground_of_tilt() - sensor[2]) * mount::dot(up, axis);
  return find_ego_vehicle(upright, ground, ego_radius);
}

void examine_from_sensor(const UsablePoints& usable, Examination& seen) {
  std::vector<Vector3f> places =
      turned(usable.places, seen.orientation.axis, seen.extent.metres, {});
  const bool has_ground = seen.orientation.is_found();
  const double ground = seen.orientation.ground_of_axis();
  Vector3f sensor{};
  const auto set_origin = [&](const std::optional<BeamOrigin>& origin) {
    seen.origin = origin;
    if (!origin || !origin->is_elsewhere()) return;
    sensor = origin->place;
    move_origin(places, sensor);
  };
  if (has_ground) set_origin(find_beam_origin(places, ground));
  const BeamRings rings = find_rings(places, usable.rings);
  if (has_ground && !seen.origin) set_origin(find_beam_origin(places, rings, ground));
  if (has_ground) seen.vehicle = ego_vehicle(usable.places, sensor, seen);
  const double height = has_ground ? double{sensor[2]} - ground : 0;
  seen.rings = rings.source;
  seen.view = find_field_of_view(places, rings, std::max(1.0, 0.8 * height));
  seen.downsampling = find_downsampling(places);
}

}  // namespace

bool Extent::is_far_away() const noexcept {
  const double away = std::max(std::abs(double{middle[0]}), std::abs(double{middle[1]}));
  return away > 3 * std::max(spread, 1e-30);
}

Examination examine(const io::Cloud& cloud) {
  const UsablePoints usable = usable_points(cloud);
  Examination seen{.points = usable.given,
                   .zero = usable.zero,
                   .not_finite = usable.not_finite,
                   .repeated = usable.repeated};
  if (!seen.has_enough_points()) return seen;
  seen.extent = extent_of(usable.places);
  if (seen.extent.is_far_away()) {
    seen.downsampling = find_downsampling(turned(usable.places, {0, 0, 1}, 1, seen.extent.middle));
    return seen;
  }
  seen.orientation = find_orientation(usable.places, seen.extent.metres);
  examine_from_sensor(usable, seen);
  return seen;
}

}  // namespace flagstone::doctor
