// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#include "app/doctor/examination.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "app/doctor/usable_points.hpp"

namespace flagstone::doctor {
namespace {

/// Around the sensor, metres: as far as the own vehicle is looked for.
constexpr double own_radius = 2.7;

/// The points in metres, turned so that the axis that is up becomes z; from the place at
/// `middle`, in the units of the file.
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

void raise(std::vector<Vector3f>& places, double origin) {
  for (Vector3f& place : places) place[2] -= static_cast<float>(origin);
}

/// What stands around the sensor, which is `origin` metres along the axis from the cloud's origin.
OwnVehicle ego_vehicle(std::span<const Vector3f> places, double origin, const Examination& seen) {
  const Mount& mount = seen.orientation.decision.mount;
  const double upright = mount::dot(mount.up, seen.orientation.axis);
  std::vector<Vector3f> level = turned(places, mount.up, seen.extent.metres, {});
  raise(level, origin * upright);
  const double ground = (double{seen.orientation.ground_of_tilt()} - origin) * upright;
  return find_own_vehicle(level, ground, own_radius);
}

void look_from_sensor(const UsablePoints& usable, Examination& seen) {
  std::vector<Vector3f> places =
      turned(usable.places, seen.orientation.axis, seen.extent.metres, {});
  const BeamRings rings = find_rings(places, usable.rings);
  seen.rings = rings.source;
  double origin = 0;
  if (rings.count > 0 && seen.orientation.is_found()) {
    seen.origin = find_beam_origin(places, rings, double{seen.orientation.ground_of_axis()});
    if (seen.origin->is_elsewhere()) origin = seen.origin->height;
  }
  raise(places, origin);
  const double height =
      seen.orientation.is_found() ? origin - double{seen.orientation.ground_of_axis()} : 0;
  seen.view = find_field_of_view(places, rings, std::max(1.0, 0.8 * height));
  seen.downsampling = find_downsampling(places);
  if (seen.orientation.is_found()) seen.vehicle = ego_vehicle(usable.places, origin, seen);
}

}  // namespace

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
  seen.orientation = find_stance(usable.places, seen.extent.metres);
  look_from_sensor(usable, seen);
  return seen;
}

}  // namespace flagstone::doctor
