// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// How the beam of a point was determined.
enum class RingSource {
  none,
  field,  ///< a field `ring` of the file
  order,  ///< the points are listed ring after ring
};

/// The beam of each point.
struct BeamRings {
  RingSource source = RingSource::none;
  std::vector<int> of_points;  ///< 0 to count - 1; empty if unknown
  int count = 0;               ///< number of beams; 0 if unknown
};

/// Determines the beam of each point, from the field if there is one, otherwise from the order of
/// the points. `places`: z is the rotation axis of the sensor. `field`: ring numbers, or empty.
BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field);

/// The point from which the beams come, estimated from a scan. The beams of a spinning sensor have
/// fixed elevations. Computed from the true origin, the elevations are sharp; from any other point
/// they are blurred.
struct BeamOrigin {
  Vector3f place{};                ///< metres
  double sharpness = 0;            ///< of the elevations computed from `place`
  double sharpness_at_origin = 0;  ///< of the elevations computed from the origin of the cloud

  /// True if the position is clearly not the origin of the cloud.
  [[nodiscard]] bool is_elsewhere() const noexcept;
};

/// Finds the origin from the comb that the elevations of all points form, without ring numbers.
/// `places`: metres; z is the rotation axis of the sensor, the ground is at z = `ground`. Returns
/// nothing if no position gives a clear comb: too few points above the ground, a rosette, beams
/// closer together than the noise, or another rotation axis.
std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, double ground);

/// Finds only the height of the origin, from the elevations of the points of each ring; use it if
/// all points together form no comb. Returns nothing if the rings are unknown or if too few points
/// are above the ground.
std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, const BeamRings& rings,
                                           double ground);

/// Field of view of a sensor, estimated from the points of a scan.
struct FieldOfView {
  int beams = 0;             ///< 0: unknown
  double top = 0;            ///< elevation, degrees
  double bottom = 0;         ///< elevation, degrees
  double azimuth_begin = 0;  ///< degrees counter-clockwise from x, -180 to 180
  double azimuth_width = 0;  ///< degrees, 360 all around

  [[nodiscard]] bool sees_all_around() const noexcept { return azimuth_width >= 360; }
};

/// `places`: metres; the sensor is at the origin, z is its rotation axis. Points closer than
/// `nearest`, metres, are excluded because they may be on the ego vehicle.
FieldOfView find_field_of_view(std::span<const Vector3f> places, const BeamRings& rings,
                               double nearest);

}  // namespace flagstone::doctor
