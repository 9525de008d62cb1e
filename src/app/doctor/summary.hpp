// SPDX-FileCopyrightText: 2026 flagstone contributors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "app/doctor/examination.hpp"

namespace flagstone::doctor {

/// Smaller tilts, in degrees, are ignored and the axis is used as up: they may come from a cambered
/// street or a hill.
inline constexpr double least_tilt = 5;

/// Orientation of the frame relative to the ground, common to most of several scans.
struct CommonOrientation {
  std::size_t scans = 0;     ///< number of scans with this axis
  Vector3f axis{0, 0, 1};    ///< the axis of the cloud that is nearest to up
  Vector3f up{0, 0, 1};      ///< up in the cloud's frame, unit length
  double tilt = 0;           ///< degrees between `axis` and `up`
  double ground = 0;         ///< along the axis from the cloud's origin, metres: the median
  double lowest_ground = 0;  ///< of all scans
  double highest_ground = 0;

  /// True if `up` is used instead of the axis.
  [[nodiscard]] bool is_tilted() const noexcept { return tilt >= least_tilt; }
};

/// Results of several scans of one sensor: medians, and fractions of all points.
struct Summary {
  std::size_t scans = 0;
  double points = 0;
  double usable = 0;
  double zero = 0;        ///< fraction of points, 0 to 1
  double not_finite = 0;  ///< fraction of points
  double repeated = 0;    ///< fraction of usable points

  /// If false, the members below are not set.
  bool has_enough_points = false;
  double metres = 1;         ///< metres per unit
  Vector3f middle{};         ///< of the points, in the file's units
  bool is_far_away = false;  ///< far from the origin, on one side of it
  bool is_from_many_places = false;
  double reach = 0;     ///< metres; 99 % of the points are closer
  double farthest = 0;  ///< metres

  std::optional<CommonOrientation> orientation{};  ///< empty: no ground found in any scan
  MountDecision refusal{};                         ///< the reason, for the first scan
  bool shows_beam_origin = false;                  ///< the points show where the beams come from
  std::optional<Vector3f> beam_origin{};  ///< metres, in the frame of the cloud rotated so that the
                                          ///< axis is z; empty if it is the origin or unknown
  RingSource rings = RingSource::none;
  FieldOfView view{};
  double growth = 0;  ///< `Downsampling::growth`
  bool is_voxel_averaged = false;
  EgoVehicle vehicle{};

  /// True if the points can be a scan of one sensor.
  [[nodiscard]] bool is_scan() const noexcept {
    return has_enough_points && !is_far_away && !is_from_many_places;
  }
};

/// Combines the results of at least one scan.
Summary summarise(std::span<const Examination> scans);

}  // namespace flagstone::doctor
