// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "library/mount/vectors.hpp"

namespace flagstone::doctor {

using mount::Vector3f;

/// Where the beam of a point is known from.
enum class RingSource {
  none,
  field,  ///< a field `ring` of the file
  order,  ///< the points are listed ring after ring
};

/// Which beam each point comes from.
struct BeamRings {
  RingSource source = RingSource::none;
  std::vector<int> of_points;  ///< 0 to count - 1; empty if not known
  int count = 0;               ///< beams; 0 if not known
};

/// `places`: z is the axis the sensor turns about. `field`: ring numbers from the file, or empty.
BeamRings find_rings(std::span<const Vector3f> places, std::span<const int> field);

/// Where the beams come from, as far as their points show. The beams of a spinning sensor have
/// fixed elevations: seen from where they meet they are sharp, from anywhere else they are blurred.
struct BeamOrigin {
  Vector3f place{};                ///< metres
  double sharpness = 0;            ///< of the beams seen from there
  double sharpness_at_origin = 0;  ///< of the beams seen from the cloud's origin

  /// Is that place elsewhere than the cloud's origin, without doubt?
  [[nodiscard]] bool is_elsewhere() const noexcept;
};

/// From the comb that the elevations of all points form; needs no ring numbers. `places`: metres, z
/// is the axis the sensor turns about, above a ground at z = `ground`. Nothing if no place shows a
/// clear comb: too few points off the ground, a rosette, beams closer together than the noise, or
/// an axis that is not the sensor's.
std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, double ground);

/// From the elevations of each ring's points, where those of all points form no comb: only the
/// height. Nothing if the rings are not known or if too few points are off the ground.
std::optional<BeamOrigin> find_beam_origin(std::span<const Vector3f> places, const BeamRings& rings,
                                           double ground);

/// What a sensor looks at, as far as points came back.
struct FieldOfView {
  int beams = 0;             ///< 0: not known
  double top = 0;            ///< degrees above the horizontal
  double bottom = 0;         ///< the same
  double azimuth_begin = 0;  ///< degrees counter-clockwise from x, -180 to 180
  double azimuth_width = 0;  ///< degrees, 360 all around

  [[nodiscard]] bool sees_all_around() const noexcept { return azimuth_width >= 360; }
};

/// `places`: metres, the sensor in the origin, z is the axis it turns about. Points nearer than
/// `nearest`, metres, are left out: they lie on the vehicle.
FieldOfView find_field_of_view(std::span<const Vector3f> places, const BeamRings& rings,
                               double nearest);

}  // namespace flagstone::doctor
